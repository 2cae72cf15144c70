#pragma once

#include "fem_solver/assembly/assembly.hpp"
#include "fem_solver/integration/newton.hpp"
#include "fem_solver/model/state.hpp"

namespace talus::fem {

struct EquilibriumOptions {
  std::int64_t steps = 10;  ///< in which weight and loads without a table come on
  NewtonOptions newton{};
};

/// The structure as it hangs before time 0: at rest under its weight, its prestress, and what its loads and moving
/// supports are at time 0, with the initial velocities of the scene. It has no interface yet.
/// @throws core::NumericalError where there is no equilibrium, or a mechanism that nothing resists
State equilibrium(const Model& model, Assembly& assembly, const EquilibriumOptions& options);

}  // namespace talus::fem
