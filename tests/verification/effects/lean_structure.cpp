#include "tests/verification/effects/lean_structure.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include "fem_solver/integration/external_force.hpp"

namespace talus::test {

using namespace fem;

LeanStructure::LeanStructure(const Model& model, double step) : model_(model), assembly_(model), step_(step) {
  const std::size_t values = model.reference.size();
  displacement_.assign(values, 0);
  velocity_.assign(values, 0);
  force_.assign(values, 0);
  reactions_.assign(reaction_count(model), 0);
  for (const auto& initial : model.initial_velocities)
    for (const Index node : initial.nodes) Vector3::Map(&velocity_[3 * node]) = initial.velocity;
  for (const double m : model.node_masses) inverse_mass_.insert(inverse_mass_.end(), 3, 1 / m);
  sum_.reserve(static_cast<std::int64_t>(values));
}

void LeanStructure::step() {
  const double kick = 0.5 * (previous_step_ + step_);
  assembly_.internal_force(displacement_, force_);
  hold_supports(kick);
  if (!std::isfinite(move_nodes(kick))) throw std::runtime_error("velocities overflow");
  previous_step_ = step_;
}

void LeanStructure::hold_supports(double kick) noexcept {
  std::size_t offset = 0;
  for (const Support& support : model_.supports)
    for (const Index node : support.nodes) {
      const auto dof = 3 * static_cast<std::size_t>(node);
      const double mass = model_.node_masses[static_cast<std::size_t>(node)];
      for (std::size_t c = 0; c < 3; ++c) {
        if (!support.fixed[c]) continue;
        const double needed = mass * -velocity_[dof + c] / kick;
        reactions_[offset + c] = needed - force_[dof + c];
        force_[dof + c] = needed;
      }
      offset += 3;
    }
}

double LeanStructure::move_nodes(double kick) noexcept {
  return sum_.of_blocks(static_cast<std::int64_t>(velocity_.size()), 0.0,
                        [&](core::Block values) { return move_nodes(kick, values); });
}

double LeanStructure::move_nodes(double kick, core::Block values) noexcept {
  constexpr std::int64_t width = 8;
  double* __restrict velocity = velocity_.data();
  double* __restrict displacement = displacement_.data();
  const double* __restrict force = force_.data();
  const double* __restrict inverse_mass = inverse_mass_.data();
  const auto advance = [&](std::int64_t i) {
    const double after = velocity[i] + kick * inverse_mass[i] * force[i];
    velocity[i] = after;
    displacement[i] += step_ * after;
    return after * after;
  };
  std::array<double, width> sums{};
  std::int64_t i = values.begin;
  for (; i + width <= values.end; i += width)
    for (std::int64_t lane = 0; lane < width; ++lane) sums[lane] += advance(i + lane);
  double sum = 0;
  for (; i < values.end; ++i) sum += advance(i);
  for (const double lane : sums) sum += lane;
  return sum;
}

}  // namespace talus::test
