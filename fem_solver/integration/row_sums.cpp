#include "fem_solver/integration/row_sums.hpp"

#include "fem_solver/integration/external_force.hpp"

namespace talus::fem {

std::vector<double> stiffness_row_sums(const Model& model, std::span<const double> displacement) {
  std::vector<double> sums(model.reference.size(), 0.0);
  const auto add = [&](Index row, Index, const Matrix3& block) {
    Vector3::Map(&sums[3 * static_cast<std::size_t>(row)]) += block.cwiseAbs().rowwise().sum();
  };
  for (const auto& part : model.parts)
    std::visit([&](const auto& batch) { batch.stiffness(displacement, add); }, part.elements);
  for_each_support(model, [&](const Support& support, std::size_t dof, std::size_t) {
    for (std::size_t c = 0; c < 3; ++c)
      if (support.fixed[c]) sums[dof + c] = 0;
  });
  return sums;
}

FrequencyBound frequency_bound(const Model& model, std::span<const double> displacement) {
  const std::vector<double> sums = stiffness_row_sums(model, displacement);
  FrequencyBound bound;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double mass = model.node_masses[i / 3];
    if (mass > 0 && sums[i] > bound.squared * mass) bound = {sums[i] / mass, i};
  }
  return bound;
}

}  // namespace talus::fem
