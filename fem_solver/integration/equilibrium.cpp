#include "fem_solver/integration/equilibrium.hpp"

#include "fem_solver/integration/static_solver.hpp"

namespace talus::fem {

State equilibrium(const Model& model, Assembly& assembly, const EquilibriumOptions& options) {
  const double step = 1 / static_cast<double>(options.steps);
  StaticSolver solver(model, assembly, {.end = 1, .step = step, .newton = options.newton, .tables_at = 0.0});
  for (std::int64_t k = 0; k < options.steps; ++k) solver.advance(static_cast<double>(k) * step, step);
  State state = solver.state();
  state.velocity = initial_state(model).velocity;
  return state;
}

}  // namespace talus::fem
