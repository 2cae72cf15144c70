#include "coupler/schemes/work_meter.hpp"

namespace talus::coupler {

void WorkMeter::begin(std::span<const double> force, const Motion& start, double length) {
  loaded_.clear();
  for (std::size_t i = 0; i < force.size(); ++i) {
    if (force[i] == 0) continue;
    loaded_.push_back({.index = i,
                       .force = force[i],
                       .start = start.displacement[i],
                       .path_before = length * start.velocity[i]});
  }
}

void WorkMeter::end(std::span<const double> displacement) {
  for (const auto& value : loaded_) {
    const double path = displacement[value.index] - value.start;
    joules_ += value.force * (meaning_ == ForceMeaning::mean ? path : 0.5 * (path + value.path_before));
  }
  loaded_.clear();
}

void WorkMeter::add(std::span<const double> mean_force, std::span<const double> start,
                    std::span<const double> end) {
  for (std::size_t i = 0; i < mean_force.size(); ++i) joules_ += mean_force[i] * (end[i] - start[i]);
}

}  // namespace talus::coupler
