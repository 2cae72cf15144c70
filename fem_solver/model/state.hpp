#pragma once

#include <vector>

#include "core/output/checkpoint.hpp"
#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// Where the structure is in its motion, whatever moves it. Integrators add what their method carries from step to
/// step. Copying a state is saving it: the model is constant, and every number that a step depends on is in here.
struct State {
  std::vector<double> displacement;  ///< m, 3 a node
  std::vector<double> velocity;      ///< m/s, 3 a node; leapfrog: half a step before the displacement's time
  std::vector<double> memory;        ///< of elements: what followed from the steps accepted so far

  std::vector<double> record;  ///< of the largest forces so far (ForceRecord); empty where nobody asks

  Configuration configuration() const { return {displacement, memory}; }
  bool operator==(const State&) const = default;
};

/// At rest as the scene describes it, but for initial velocities.
State initial_state(const Model& model);

/// Writes or reads it as a part of a file.
void archive(core::StateArchive& archive, State& state);

}  // namespace talus::fem
