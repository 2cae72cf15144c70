#include "fem_solver/integration/mass_scaling.hpp"

#include <algorithm>

#include "fem_solver/integration/frequency_bound.hpp"

namespace talus::fem {

AddedMass scale_masses(Model& model, double step) {
  const double frequency_squared = 4 / (step * step + 2 * largest_stiffness_damping(model) * step);
  const std::vector<double> rest(model.reference.size(), 0.0);
  const std::vector<double> sums = free_stiffness_bounds(model, rest);
  AddedMass added;
  double before = 0;
  for (std::size_t node = 0; node < model.node_masses.size(); ++node) {
    double& mass = model.node_masses[node];
    const double stiffest = std::max({sums[3 * node], sums[3 * node + 1], sums[3 * node + 2]});
    const double missing = std::max(0.0, stiffest / frequency_squared - mass);
    before += mass;
    mass += missing;
    added.kilograms += missing;
    added.nodes += missing > 0 ? 1 : 0;
  }
  added.share = before > 0 ? added.kilograms / before : 0;
  return added;
}

}  // namespace talus::fem
