#include "coupler/schemes/work_meter.hpp"

#include <cstddef>

namespace talus::coupler {

void WorkMeter::begin(std::span<const double> force, std::span<const double> displacement) {
  loaded_.clear();
  for (std::size_t i = 0; i < force.size(); ++i) {
    if (force[i] != 0) loaded_.push_back({.index = i, .force = force[i], .start = displacement[i]});
  }
}

void WorkMeter::end(std::span<const double> displacement) {
  for (const auto& value : loaded_) joules_ += value.force * (displacement[value.index] - value.start);
  loaded_.clear();
}

}  // namespace talus::coupler
