#include "fem_solver/integration/slide_run.hpp"

#include <algorithm>

#include "fem_solver/constraints/held_directions.hpp"

namespace talus::fem {

SlideRun::SlideRun(const Model& model, const SlideLine& line)
    : model_(model),
      rope_nodes_(line.rope.size()),
      nodes_(line.rope),
      projection_({.rope_nodes = line.rope.size(), .sliders = line.sliders.size()}) {
  nodes_.insert(nodes_.end(), line.sliders.begin(), line.sliders.end());
  for (auto* array : {&positions_, &velocities_, &forces_, &pulls_}) array->resize(3 * nodes_.size());
  for (const Index node : nodes_)
    inverse_masses_.insert(inverse_masses_.end(), 3, 1 / model.node_masses[static_cast<std::size_t>(node)]);
  for (const HeldDirection& h : held_directions(model)) {
    const auto found = std::ranges::find(nodes_, static_cast<Index>(h.direction / 3));
    if (found == nodes_.end()) continue;
    const std::size_t local = 3 * static_cast<std::size_t>(found - nodes_.begin()) + h.direction % 3;
    inverse_masses_[local] = 0;
    held_.push_back({local, h.reaction});
  }
}

bool SlideRun::project(const Step& step, const Arrays& arrays) noexcept {
  take(step, arrays);
  const bool converged = projection_.project({positions_, inverse_masses_, step.length}, velocities_);
  give(step, arrays);
  pull_supports(step.force_factor, arrays.reactions);
  return converged;
}

/// Positions at the step's start, and the velocities of the free step.
void SlideRun::take(const Step& step, const Arrays& arrays) noexcept {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto node = 3 * static_cast<std::size_t>(nodes_[k]);
    for (std::size_t c = 0; c < 3; ++c) {
      const double velocity = arrays.velocity[node + c];
      velocities_[3 * k + c] = velocity;
      positions_[3 * k + c] =
          model_.reference[node + c] + arrays.displacement[node + c] - step.length * velocity;
    }
  }
}

void SlideRun::give(const Step& step, const Arrays& arrays) noexcept {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto node = 3 * static_cast<std::size_t>(nodes_[k]);
    for (std::size_t c = 0; c < 3; ++c) {
      const double change = velocities_[3 * k + c] - arrays.velocity[node + c];
      arrays.displacement[node + c] += step.length * change;
      arrays.velocity[node + c] += change;
      forces_[3 * k + c] = model_.node_masses[node / 3] * step.force_factor * change;
      arrays.force[node + c] += forces_[3 * k + c];
    }
  }
}

double SlideRun::power(std::span<const double> velocity) const noexcept {
  double sum = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    sum +=
        Vector3::Map(&forces_[3 * k]).dot(Vector3::Map(&velocity[3 * static_cast<std::size_t>(nodes_[k])]));
  return sum;
}

/// Supports hold the share of the impulses that falls to their nodes.
void SlideRun::pull_supports(double force_factor, std::span<double> reactions) noexcept {
  if (held_.empty()) return;
  std::ranges::fill(pulls_, 0.0);
  for (std::size_t k = 0; k < projection_.contacts().size(); ++k) {
    const auto& contact = projection_.contacts()[k];
    const Vector3 impulse = Vector3::Map(&projection_.impulses()[3 * k]);
    Vector3::Map(&pulls_[3 * (rope_nodes_ + k)]) += impulse;
    Vector3::Map(&pulls_[3 * contact.segment]) -= (1 - contact.fraction) * impulse;
    Vector3::Map(&pulls_[3 * contact.segment + 3]) -= contact.fraction * impulse;
  }
  for (const auto& [direction, reaction] : held_) reactions[reaction] -= force_factor * pulls_[direction];
}

}  // namespace talus::fem
