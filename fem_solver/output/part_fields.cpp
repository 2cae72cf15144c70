#include "fem_solver/output/part_fields.hpp"

namespace talus::fem {
namespace {

enum AxialField : std::size_t { axial_force, stress };

template <class Compression>
void fill(const TwoNodeBatch<Compression>& batch, std::size_t field, std::span<const double> displacement,
          std::span<double> values) {
  for (Index e = 0; e < batch.size(); ++e) {
    const auto i = static_cast<std::size_t>(e);
    values[i] = field == axial_force ? batch.axial_force(displacement, e) : batch.stress(displacement, e);
  }
}

}  // namespace

core::CellKind cell_kind(const ElementBatch&) {
  return core::CellKind::segment;
}

std::vector<core::FieldDescription> element_fields(const ElementBatch&) {
  using core::FieldLocation;
  return {{.name = "axial_force", .unit = "N", .components = 1, .location = FieldLocation::cell},
          {.name = "stress", .unit = "Pa", .components = 1, .location = FieldLocation::cell}};
}

void fill_element_field(const ElementBatch& elements, std::size_t field, std::span<const double> displacement,
                        std::span<double> values) {
  std::visit([&](const auto& batch) { fill(batch, field, displacement, values); }, elements);
}

}  // namespace talus::fem
