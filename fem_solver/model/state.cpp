#include "fem_solver/model/state.hpp"

namespace talus::fem {

State initial_state(const Model& model) {
  State state{.displacement = std::vector<double>(model.reference.size(), 0.0),
              .velocity = std::vector<double>(model.reference.size(), 0.0),
              .memory = initial_memory(model),
              .record = {}};
  for (const auto& initial : model.initial_displacements)
    for (const Index node : initial.nodes) Vector3::Map(&state.displacement[3 * node]) = initial.displacement;
  for (const auto& initial : model.initial_velocities)
    for (const Index node : initial.nodes) Vector3::Map(&state.velocity[3 * node]) = initial.velocity;
  return state;
}

void archive(core::StateArchive& archive, State& state) {
  archive.values("displacement", state.displacement);
  archive.values("velocity", state.velocity);
  archive.values("element_memory", state.memory);
  if (!state.record.empty()) archive.values("force_record", state.record);
}

}  // namespace talus::fem
