#pragma once

#include <vector>

#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// A state remembered together with what the model's elements remember (friction, brakes, plasticity), so
/// that an iteration of a window can start again from it.
template <class State>
class Snapshot {
 public:
  void take(const State& state, const Model& model) {
    state_ = state;
    memory_ = element_memory(model);
  }
  /// @pre taken from the same model
  void put_back(State& state, const Model& model) const {
    state = state_;
    restore_element_memory(model, memory_);
  }

 private:
  State state_;
  std::vector<double> memory_;
};

}  // namespace talus::fem
