#include "fem_solver/integration/row_sums.hpp"

#include "fem_solver/constraints/held_directions.hpp"

namespace talus::fem {

std::vector<double> stiffness_row_sums(const Model& model, const Configuration& at) {
  std::vector<double> sums(model.reference.size(), 0.0);
  const auto add = [&](Index row, Index, const Matrix3& block) {
    Vector3::Map(&sums[3 * static_cast<std::size_t>(row)]) += block.cwiseAbs().rowwise().sum();
  };
  for_each_part(model, at,
                [&](std::size_t, const auto& batch, const Configuration& own) { batch.stiffness(own, add); });
  for (const HeldDirection& h : held_directions(model)) sums[h.direction] = 0;
  return sums;
}

FrequencyBound frequency_bound(const Model& model, const Configuration& at) {
  const std::vector<double> sums = stiffness_row_sums(model, at);
  FrequencyBound bound;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double mass = model.node_masses[i / 3];
    if (mass > 0 && sums[i] > bound.squared * mass) bound = {sums[i] / mass, i};
  }
  return bound;
}

}  // namespace talus::fem
