#include "fem_solver/elements/rope_chain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace talus::fem {
namespace {

constexpr double floor_share = 1e-13;  // of E A
/// Of the last change of a tension, of E A: what it leaves is of the order of its square.
constexpr double near_enough = 1e-8;
constexpr int most_sweeps = 8;
constexpr int most_iterations = 400;  // bisection alone, which every fifth step is, ends before

}  // namespace

bool RopeChain::solve(const RopeLaw& law, const RopeState& state, std::span<const double> old_material,
                      std::span<double> material, std::span<double> slips) {
  const auto usable = [](double value) { return value > 0 && std::isfinite(value); };
  if (!std::ranges::all_of(state.lengths, usable) || !std::ranges::all_of(old_material, usable)) return false;
  const std::size_t m = old_material.size();
  for (auto* of_segments : {&root_, &tension_, &before_, &material_, &constant_, &slope_})
    of_segments->resize(m);
  slips_.resize(m);
  const Problem problem{law, state, old_material,
                        floor_share * law.section().area * law.section().youngs_modulus};
  if (is_slack(problem)) {
    share_slack(problem, material, slips);
    return true;
  }
  if (!sweep_tangents(problem)) roots_of_excess(problem);
  share_out(problem, material, slips);
  return true;
}

/// As a whole, and not held in parts.
bool RopeChain::is_slack(const Problem& problem) noexcept {
  double missing = 0;
  for (std::size_t i = 0; i < problem.old_material.size(); ++i)
    missing += problem.state.lengths[i] / problem.law.slack_stretch() - problem.old_material[i];
  return missing <= 0 && std::ranges::none_of(problem.state.grips, [](double a) { return std::isinf(a); });
}

/// M_i = max(M_i^old - c, l_i/q_0) with the c >= 0 that keeps the sum: Newton's method on a falling, piecewise linear,
/// convex function of c climbs to its root without overshoot.
void RopeChain::share_slack(const Problem& problem, std::span<double> material,
                            std::span<double> slips) noexcept {
  const std::size_t m = material.size();
  double given = 0;
  const auto needed = [&](std::size_t i) { return problem.state.lengths[i] / problem.law.slack_stretch(); };
  for (std::size_t step = 0; step <= m; ++step) {
    double excess = 0;
    std::size_t givers = 0;
    for (std::size_t i = 0; i < m; ++i) {
      const double kept = problem.old_material[i] - given;
      excess += std::max(kept, needed(i)) - problem.old_material[i];
      givers += kept > needed(i);
    }
    if (excess <= 0 || givers == 0) break;
    given += excess / static_cast<double>(givers);
  }
  double passed = 0;
  for (std::size_t i = 0; i < m; ++i) {
    const double old = problem.old_material[i];
    material[i] = std::max(old - given, needed(i));
    passed += old - material[i];
    if (i < slips.size()) slips[i] = passed;
  }
}

/// Newton's method on all segments at once. @return whether it has arrived
bool RopeChain::sweep_tangents(const Problem& problem) noexcept {
  const std::size_t m = problem.old_material.size();
  const double close = near_enough * problem.law.section().area * problem.law.section().youngs_modulus;
  for (std::size_t i = 0; i < m; ++i) {
    const double old = problem.old_material[i],
                 q = std::max(problem.state.lengths[i] / old, problem.law.slack_stretch());
    const double taut =
        problem.state.lengths[i] / q;  // less than `old` where slack: the tangent at no tension
    tension_[i] = problem.law.tension(q);
    slope_[i] = taut / (q * problem.law.taut_slope(q));
    constant_[i] = old - taut - slope_[i] * tension_[i];
  }
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    if (!roots_of_tangents(problem)) return false;
    std::swap(before_, tension_);
    tensions_from_roots(problem.state);
    double change = 0;
    for (std::size_t i = 0; i < m; ++i) change = std::max(change, std::abs(tension_[i] - before_[i]));
    if (change <= close) return true;
    for (std::size_t i = 0; i < m; ++i) {
      const Excess here = held(problem, i, tension_[i]);
      slope_[i] = here.slope;
      constant_[i] = problem.old_material[i] - here.metres - here.slope * tension_[i];
    }
  }
  return false;
}

/// e_i is kept as the straight piece at its root, and corners on either side of it; those of the left side are scaled
/// towards zero by every node that is passed, those of the right away from it, in one common factor.
/// @return false where a segment would be slack
bool RopeChain::roots_of_tangents(const Problem& problem) noexcept {
  double constant = 0, slope = 0, reach = 1;
  left_.clear();
  right_.clear();
  const std::size_t m = problem.old_material.size();
  for (std::size_t i = 0; i < m; ++i) {
    constant += constant_[i];
    slope += slope_[i];
    while (!left_.empty() && constant + slope * (left_.back().tension / reach) > 0) {
      const Corner corner{left_.back().tension / reach, left_.back().constant, left_.back().slope * reach};
      left_.pop_back();
      constant += corner.constant;
      slope += corner.slope;
      right_.push_back({corner.tension / reach, -corner.constant, -corner.slope * reach});
    }
    while (!right_.empty() && constant + slope * (right_.back().tension * reach) < 0) {
      const Corner corner{right_.back().tension * reach, right_.back().constant, right_.back().slope / reach};
      right_.pop_back();
      constant += corner.constant;
      slope += corner.slope;
      left_.push_back({corner.tension * reach, -corner.constant, -corner.slope / reach});
    }
    const double root = -constant / slope;
    if (!(root > problem.floor)) return false;
    root_[i] = root;
    if (i + 1 == m) break;
    const double a = problem.state.grips[i];
    if (std::isinf(a)) {
      left_.clear();
      right_.clear();
      reach = 1;
    } else {
      reach *= a;
      left_.push_back({root / a * reach, constant, slope * a / reach});
      right_.push_back({root * a / reach, constant, slope / a * reach});
      if (!std::isfinite(reach)) return false;
    }
    constant = slope = 0;
  }
  return true;
}

void RopeChain::roots_of_excess(const Problem& problem) noexcept {
  for (std::size_t i = 0; i < root_.size(); ++i) root_[i] = root(problem, i);
  tensions_from_roots(problem.state);
}

void RopeChain::tensions_from_roots(const RopeState& state) noexcept {
  tension_.back() = root_.back();
  slips_.back() = false;
  for (std::size_t k = root_.size() - 1; k-- > 0;) {
    const Seen seen = through_node(state, k, tension_[k + 1]);
    tension_[k] = seen.slips ? seen.tension : root_[k];
    slips_[k] = seen.slips;
  }
}

/// The tension of segment `node` if the next one has `tension`: at the limit where the node slips.
RopeChain::Seen RopeChain::through_node(const RopeState& state, std::size_t node,
                                        double tension) const noexcept {
  const double a = state.grips[node], r = root_[node];
  if (tension * a < r) return {true, tension * a, a};
  if (tension > r * a) return {true, tension / a, 1 / a};
  return {false, r, 0};
}

/// What segment i holds at a tension, and the derivative with its sign turned.
RopeChain::Excess RopeChain::held(const Problem& problem, std::size_t i, double tension) noexcept {
  const double q = problem.law.stretch_at(tension, problem.state.lengths[i] / problem.old_material[i]),
               taut = problem.state.lengths[i] / q;
  const double by_stretch = taut / (q * problem.law.taut_slope(q));
  if (tension >= problem.floor) return {taut, by_stretch};
  const double slack = problem.old_material[i] * problem.floor / tension;
  return {taut + slack - problem.old_material[i], by_stretch + slack / tension};
}

/// Goes back from segment `last` as far as nodes slip at this tension.
RopeChain::Excess RopeChain::excess(const Problem& problem, std::size_t last, double tension) const noexcept {
  Excess sum{0, 0};
  double N = tension, by_tension = 1;  // dN/d tension
  for (std::size_t i = last;; --i) {
    const Excess here = held(problem, i, N);
    sum.metres += problem.old_material[i] - here.metres;
    sum.slope += here.slope * by_tension;
    if (i == 0) return sum;
    const Seen seen = through_node(problem.state, i - 1, N);
    if (!seen.slips) return sum;
    N = seen.tension;
    by_tension *= seen.factor;
  }
}

/// Newton's method inside a bracket that closes, as the function has kinks.
double RopeChain::root(const Problem& problem, std::size_t last) const noexcept {
  double low = 0, high = std::numeric_limits<double>::infinity();
  double N =
      std::max(problem.floor, problem.law.tension(problem.state.lengths[last] / problem.old_material[last]));
  for (int iteration = 1; iteration < most_iterations; ++iteration) {
    const Excess at = excess(problem, last, N);
    if (at.metres == 0) return N;
    (at.metres > 0 ? high : low) = N;
    double next = N - at.metres / at.slope;
    if (!(next > low && next < high) || iteration % 5 == 0)
      next = !std::isfinite(high) ? 8 * N : low > 0 ? std::sqrt(low) * std::sqrt(high) : high / 8;
    if (std::abs(next - N) <= 2 * std::numeric_limits<double>::epsilon() * N) return next;
    N = next;
  }
  return N;
}

/// Material of nodes that slip together: one step of Newton's method on their common tension, which sees nothing of
/// the round-off of larger segments elsewhere. What is left goes to the segment with most material, which feels it
/// least.
void RopeChain::settle_run(const Problem& problem, std::size_t first, std::size_t end) noexcept {
  Excess sum{0, 0};
  for (std::size_t i = first; i < end; ++i) {
    const Excess here = held(problem, i, tension_[i]);
    material_[i] = here.metres;
    slope_[i] = here.slope * tension_[i];  // by the logarithm of the common tension
    sum.metres += problem.old_material[i] - here.metres;
    sum.slope += slope_[i];
  }
  const double change = sum.metres / sum.slope;
  double left = 0;
  std::size_t keeper = first;
  for (std::size_t i = first; i < end; ++i) {
    material_[i] += slope_[i] * change;
    left += problem.old_material[i] - material_[i];
    if (material_[i] > material_[keeper]) keeper = i;
  }
  material_[keeper] += left;
}

/// Old material is read before the new, which may be the same memory, is written.
void RopeChain::share_out(const Problem& problem, std::span<double> material,
                          std::span<double> slips) noexcept {
  const std::size_t m = material.size();
  for (std::size_t first = 0; first < m;) {
    std::size_t end = first + 1;
    while (end < m && slips_[end - 1]) ++end;
    if (end == first + 1)
      material_[first] = problem.old_material[first];
    else
      settle_run(problem, first, end);
    double passed = 0;
    for (std::size_t i = first; i < end; ++i) {
      passed += problem.old_material[i] - material_[i];
      if (i < slips.size()) slips[i] = i + 1 < end ? passed : 0;
    }
    first = end;
  }
  std::ranges::copy(material_, material.begin());
}

}  // namespace talus::fem
