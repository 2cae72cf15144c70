#include "fem_solver/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus::fem {

double TimeTable::at(double time) const {
  if (points.empty()) return 1;
  if (time <= points.front().first) return points.front().second;
  const auto next = std::upper_bound(points.begin(), points.end(), time,
                                     [](double t, const auto& point) { return t < point.first; });
  if (next == points.end()) return points.back().second;
  const auto& [t0, f0] = *(next - 1);
  const auto& [t1, f1] = *next;
  return f0 + (f1 - f0) * (time - t0) / (t1 - t0);
}

namespace {

template <class Batch>
constexpr bool remembers = requires(const Batch& batch) {
  batch.accept();
};

double dissipated(const FrictionalCableBatch& batch, std::span<const double>) {
  return batch.dissipated();
}
template <class Law>
double dissipated(const PathBatch<Law>& batch, std::span<const double> displacement) {
  return batch.dissipated(displacement);
}

/// visit(batch) for every part whose elements remember.
template <class Visit>
void for_each_memory(const Model& model, const Visit& visit) {
  for (const auto& part : model.parts)
    std::visit(
        [&](const auto& batch) {
          if constexpr (remembers<std::decay_t<decltype(batch)>>) visit(batch);
        },
        part.elements);
}

}  // namespace

void accept_memory(const Model& model) noexcept {
  for_each_memory(model, [](const auto& batch) { batch.accept(); });
}

std::vector<double> element_memory(const Model& model) {
  std::vector<double> values;
  for_each_memory(model, [&](const auto& batch) {
    const std::vector<double> kept = batch.memory();
    values.insert(values.end(), kept.begin(), kept.end());
  });
  return values;
}

void restore_element_memory(const Model& model, std::span<const double> values) {
  std::size_t begin = 0;
  for_each_memory(model, [&](const auto& batch) {
    batch.set_memory(values.subspan(begin, batch.memory_size()));
    begin += batch.memory_size();
  });
}

void archive_element_memory(core::StateArchive& archive, const Model& model) {
  std::vector<double> memory = element_memory(model);
  archive.values("element_memory", memory);
  restore_element_memory(model, memory);
}

bool dissipates(const ElementBatch& elements) {
  return std::visit([](const auto& batch) { return remembers<std::decay_t<decltype(batch)>>; }, elements);
}

std::vector<double> dissipated_by_parts(const Model& model, std::span<const double> displacement) {
  std::vector<double> joules(model.parts.size(), 0.0);
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    std::visit(
        [&](const auto& batch) {
          if constexpr (remembers<std::decay_t<decltype(batch)>>) joules[p] = dissipated(batch, displacement);
        },
        model.parts[p].elements);
  return joules;
}

void lump_masses(Model& model) {
  model.node_masses.assign(static_cast<std::size_t>(model.nodes()), 0.0);
  for (const auto& part : model.parts)
    std::visit([&](const auto& batch) { batch.add_mass(model.node_masses); }, part.elements);
}

std::string node_name(const Model& model, Index node) {
  const Vector3 x = model.position(node);
  const auto owner = std::find_if(model.parts.begin(), model.parts.end(), [node](const Part& part) {
    return std::binary_search(part.nodes.begin(), part.nodes.end(), node);
  });
  const std::string of = owner == model.parts.end() ? "" : " of " + owner->name;
  return fmt::format("node {}{} at ({:.6g}, {:.6g}, {:.6g}) m", node, of, x.x(), x.y(), x.z());
}

}  // namespace talus::fem
