#include "fem_solver/elements/rope_friction.hpp"

#include <algorithm>
#include <cmath>

namespace talus::fem {
namespace {

/// N(l/M), continued below slackness along its tangent, so that the system of the slips stays regular.
struct Continued {
  double tension, slope;  // N, dN/dM
};
Continued continued_tension(const RopeLaw& law, double length, double material) noexcept {
  const double q = length / material, q0 = law.slack_stretch();
  if (q > q0) return {law.tension(q), -law.tension_slope(q) * q / material};
  const double steepness = law.section().area * law.section().youngs_modulus * q0 * q0;
  return {steepness * (q - q0), -steepness * q / material};
}

}  // namespace

void RopeFriction::resize(std::size_t segments) {
  for (auto* of_segments : {&tension_, &slope_}) of_segments->resize(segments);
  for (auto* of_nodes : {&slip_, &lower_, &diagonal_, &upper_, &right_}) of_nodes->resize(segments - 1);
  motion_.resize(segments - 1);
}

bool RopeFriction::settle(const RopeLaw& law, const RopeState& state, std::span<const double> old_material,
                          std::span<double> material) {
  if (material.data() != old_material.data()) std::ranges::copy(old_material, material.begin());
  std::ranges::fill(slip_, 0.0);
  std::ranges::fill(motion_, Motion::stuck);
  evaluate(law, state, material);
  if (within_limits(state)) return true;
  if (!chain_.solve(law, state, old_material, material, slip_)) return false;
  evaluate(law, state, material);
  for (std::size_t k = 0; k < slip_.size(); ++k)
    motion_[k] = slip_[k] > 0 ? Motion::forward : slip_[k] < 0 ? Motion::backward : Motion::stuck;
  return true;
}

void RopeFriction::evaluate(const RopeLaw& law, const RopeState& state,
                            std::span<const double> material) noexcept {
  for (std::size_t i = 0; i < tension_.size(); ++i) {
    const auto [tension, slope] = continued_tension(law, state.lengths[i], material[i]);
    tension_[i] = tension;
    slope_[i] = slope;
  }
}

bool RopeFriction::within_limits(const RopeState& state) const noexcept {
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    const double near = std::max(0.0, tension_[k]), far = std::max(0.0, tension_[k + 1]), a = state.grips[k];
    if (far > a * near || near > a * far) return false;
  }
  return true;
}

/// The system for the changes of the slips: a stuck node's stays, the others keep to their limit.
void RopeFriction::assemble(const RopeState& state) noexcept {
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    if (motion_[k] == Motion::stuck) {
      lower_[k] = upper_[k] = 0;
      diagonal_[k] = 1;
      continue;
    }
    const bool forward = motion_[k] == Motion::forward;
    // F = far_factor N_(k+1) - near_factor N_k = 0, with dM_k = ds_(k-1) - ds_k
    const double near_factor = forward ? state.grips[k] : 1, far_factor = forward ? 1 : state.grips[k];
    const double near_slope = near_factor * slope_[k], far_slope = far_factor * slope_[k + 1];
    lower_[k] = -near_slope;
    diagonal_[k] = near_slope + far_slope;
    upper_[k] = -far_slope;
  }
}

void RopeFriction::solve_tridiagonal() noexcept {
  const std::size_t n = slip_.size();
  for (std::size_t k = 1; k < n; ++k) {
    const double factor = lower_[k] / diagonal_[k - 1];
    diagonal_[k] -= factor * upper_[k - 1];
    right_[k] -= factor * right_[k - 1];
  }
  for (std::size_t k = n; k-- > 0;)
    right_[k] = (right_[k] - (k + 1 < n ? upper_[k] * right_[k + 1] : 0)) / diagonal_[k];
}

void RopeFriction::tension_changes(const RopeLaw& law, const RopeState& state,
                                   std::span<const double> material, const Changes& changes,
                                   std::span<double> tension_changes) noexcept {
  for (std::size_t i = 0; i < tension_.size(); ++i)
    tension_changes[i] = law.tension_slope(state.lengths[i] / material[i]) / material[i] * changes.lengths[i];
  assemble(state);
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    if (motion_[k] == Motion::stuck) {
      right_[k] = 0;
    } else if (motion_[k] == Motion::forward) {
      right_[k] =
          -(tension_changes[k + 1] - state.grips[k] * tension_changes[k] - changes.grips[k] * tension_[k]);
    } else {
      right_[k] = -(state.grips[k] * tension_changes[k + 1] + changes.grips[k] * tension_[k + 1] -
                    tension_changes[k]);
    }
  }
  if (!slip_.empty()) solve_tridiagonal();
  for (std::size_t i = 0; i < tension_.size(); ++i) {
    const double gain = (i > 0 ? right_[i - 1] : 0) - (i < slip_.size() ? right_[i] : 0);
    tension_changes[i] += slope_[i] * gain;
  }
}

}  // namespace talus::fem
