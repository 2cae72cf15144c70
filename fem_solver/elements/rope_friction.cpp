#include "fem_solver/elements/rope_friction.hpp"

#include <algorithm>
#include <cmath>

namespace talus::fem {
namespace {

/// Of Newton's method: from one step of a run to the next it arrives in two or three.
constexpr int most_steps = 6;
/// Of the tensions, relative to M dN/dM, which is of the order of E A: what round-off of the stretch makes of
/// them.
constexpr double settled_share = 1e-14;
/// A segment gives away at most this share of its material in one Newton step.
constexpr double largest_share = 0.9;

/// N(l/M), continued below slackness along its tangent: Newton's method then knows how far from tension a
/// segment is.
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
  start_.assign(material.begin(), material.end());
  if (iterate(law, state, material)) return true;
  if (!chain_.solve(law, state, start_, material, slip_)) return false;
  evaluate(law, state, material);
  for (std::size_t k = 0; k < slip_.size(); ++k)
    motion_[k] = slip_[k] > 0 ? Motion::forward : slip_[k] < 0 ? Motion::backward : Motion::stuck;
  return true;
}

/// Newton's method; may go round in circles where many nodes are far from their answer.
bool RopeFriction::iterate(const RopeLaw& law, const RopeState& state, std::span<double> material) noexcept {
  for (int step = 0; step < most_steps; ++step) {
    predict_motion(state);
    assemble(state);
    solve_tridiagonal();
    const double share = longest_step(material);
    for (std::size_t k = 0; k < slip_.size(); ++k) pass(k, share * right_[k], material);
    evaluate(law, state, material);
    if (settled(state, settled_share * stiffest(material))) return true;
  }
  return false;
}

void RopeFriction::pass(std::size_t node, double slip, std::span<double> material) noexcept {
  slip_[node] += slip;
  material[node] -= slip;
  material[node + 1] += slip;
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

/// Every node obeys the limit, and those that have slipped stand at it, within `tolerance` (N).
bool RopeFriction::settled(const RopeState& state, double tolerance) const noexcept {
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    const double near = tension_[k], far = tension_[k + 1], a = state.grips[k];
    const double ahead = far - a * near, back = near - a * far;
    if (ahead > tolerance || back > tolerance) return false;
    if ((slip_[k] > 0 && ahead < -tolerance) || (slip_[k] < 0 && back < -tolerance)) return false;
  }
  return true;
}

/// A node moves the way a Newton step of this node alone would leave it moved.
void RopeFriction::predict_motion(const RopeState& state) noexcept {
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    const double near = tension_[k], far = tension_[k + 1], a = state.grips[k];
    const double ahead = (far - a * near) / -(slope_[k + 1] + a * slope_[k]) + slip_[k];
    const double back = (near - a * far) / -(slope_[k] + a * slope_[k + 1]) - slip_[k];
    motion_[k] = Motion::stuck;
    if (std::max(ahead, back) > 0) motion_[k] = ahead > back ? Motion::forward : Motion::backward;
  }
}

/// The system for the changes of the slips: a stuck node's slip goes back to zero, the others reach the
/// limit.
void RopeFriction::assemble(const RopeState& state) noexcept {
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    if (motion_[k] == Motion::stuck) {
      lower_[k] = upper_[k] = 0;
      diagonal_[k] = 1;
      right_[k] = -slip_[k];
      continue;
    }
    const bool forward = motion_[k] == Motion::forward;
    // F = far_factor N_(k+1) - near_factor N_k = 0, with dM_k = ds_(k-1) - ds_k
    const double near_factor = forward ? state.grips[k] : 1, far_factor = forward ? 1 : state.grips[k];
    const double near_slope = near_factor * slope_[k], far_slope = far_factor * slope_[k + 1];
    lower_[k] = -near_slope;
    diagonal_[k] = near_slope + far_slope;
    upper_[k] = -far_slope;
    right_[k] = near_factor * tension_[k] - far_factor * tension_[k + 1];
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

/// The largest M |dN/dM| (N).
double RopeFriction::stiffest(std::span<const double> material) const noexcept {
  double largest = 0;
  for (std::size_t i = 0; i < material.size(); ++i) largest = std::max(largest, -slope_[i] * material[i]);
  return largest;
}

double RopeFriction::longest_step(std::span<const double> material) const noexcept {
  double share = 1;
  for (std::size_t i = 0; i < material.size(); ++i) {
    const double gain = (i > 0 ? right_[i - 1] : 0) - (i < right_.size() ? right_[i] : 0);
    if (-gain > largest_share * material[i]) share = std::min(share, largest_share * material[i] / -gain);
  }
  return share;
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
