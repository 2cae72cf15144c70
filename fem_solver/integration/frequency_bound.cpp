#include "fem_solver/integration/frequency_bound.hpp"

#include "fem_solver/constraints/held_directions.hpp"

namespace talus::fem {

FrequencyBound frequency_bound(const Model& model, const Configuration& at) {
  const std::vector<double> sums = stiffness_bounds(model, at);
  const std::vector<bool> held = held_nodes(model);
  FrequencyBound bound;
  for (std::size_t node = 0; node < sums.size(); ++node) {
    const double mass = model.node_masses[node];
    if (!held[node] && mass > 0 && sums[node] > bound.squared * mass)
      bound = {sums[node] / mass, static_cast<Index>(node)};
  }
  return bound;
}

}  // namespace talus::fem
