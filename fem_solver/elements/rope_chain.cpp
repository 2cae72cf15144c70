#include "fem_solver/elements/rope_chain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus::fem {
namespace {

constexpr double floor_share = 1e-13;  // of E A
constexpr int most_iterations = 400;   // bisection alone, which every fifth step is, ends before

}  // namespace

bool RopeChain::solve(const RopeLaw& law, const RopeState& state, std::span<const double> old_material,
                      std::span<double> material, std::span<double> slips) {
  const auto usable = [](double value) { return value > 0 && std::isfinite(value); };
  if (!std::ranges::all_of(state.lengths, usable) || !std::ranges::all_of(old_material, usable)) return false;
  const std::size_t m = old_material.size();
  root_.resize(m);
  tension_.resize(m);
  const Problem problem{law, state, old_material,
                        floor_share * law.section().area * law.section().youngs_modulus};
  for (std::size_t i = 0; i < m; ++i) root_[i] = root(problem, i);
  tension_[m - 1] = root_[m - 1];
  slips_.assign(m, false);
  for (std::size_t k = m - 1; k-- > 0;) {
    const Seen seen = through_node(state, k, tension_[k + 1]);
    tension_[k] = seen.slips ? seen.tension : root_[k];
    slips_[k] = seen.slips;
  }
  share_out(problem, material, slips);
  return true;
}

/// The tension of segment `node` if the next one has `tension`: at the limit where the node slips.
RopeChain::Seen RopeChain::through_node(const RopeState& state, std::size_t node, double tension) const noexcept {
  const double a = state.grips[node], r = root_[node];
  if (tension * a < r) return {true, tension * a, a};
  if (tension > r * a) return {true, tension / a, 1 / a};
  return {false, r, 0};
}

/// What segment i holds at a tension, and the derivative with its sign turned.
RopeChain::Excess RopeChain::held(const Problem& problem, std::size_t i, double tension) noexcept {
  const double q = problem.law.stretch_at(tension), taut = problem.state.lengths[i] / q;
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
  double N = std::max(problem.floor, problem.law.tension(problem.state.lengths[last] / problem.old_material[last]));
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

/// Material by the tensions. What round-off leaves of the sum over nodes that slip together goes to the segment with
/// most of it, which feels it least. Old material is read before the new, which may be the same memory, is written.
void RopeChain::share_out(const Problem& problem, std::span<double> material,
                          std::span<double> slips) const noexcept {
  const std::size_t m = material.size();
  for (std::size_t first = 0; first < m;) {
    std::size_t end = first + 1;
    while (end < m && slips_[end - 1]) ++end;
    double left = 0;
    std::size_t keeper = first;
    for (std::size_t i = first; i < end; ++i) {
      const double old = problem.old_material[i];
      left += old;
      if (i < slips.size()) slips[i] = old;
      material[i] = end == first + 1 ? old : held(problem, i, tension_[i]).metres;
      if (material[i] > material[keeper]) keeper = i;
    }
    for (std::size_t i = first; i < end; ++i) left -= material[i];
    material[keeper] += left;
    double passed = 0;
    for (std::size_t i = first; i + 1 < end; ++i) {
      passed += slips[i] - material[i];
      slips[i] = passed;
    }
    if (end - 1 < slips.size()) slips[end - 1] = 0;
    first = end;
  }
}

}  // namespace talus::fem
