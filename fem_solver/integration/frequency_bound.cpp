#include "fem_solver/integration/frequency_bound.hpp"

#include "fem_solver/constraints/held_directions.hpp"

namespace talus::fem {

std::vector<double> free_stiffness_bounds(const Model& model, const Configuration& at) {
  std::vector<double> sums = stiffness_bounds(model, at);
  for (const HeldDirection& h : held_directions(model)) sums[h.direction] = 0;
  return sums;
}

FrequencyBound frequency_bound(const Model& model, const Configuration& at) {
  const std::vector<double> sums = free_stiffness_bounds(model, at);
  FrequencyBound bound;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double mass = model.node_masses[i / 3];
    if (mass > 0 && sums[i] > bound.squared * mass) bound = {sums[i] / mass, static_cast<Index>(i / 3)};
  }
  return bound;
}

}  // namespace talus::fem
