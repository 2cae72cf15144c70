#pragma once

#include <span>
#include <vector>

#include "fem_solver/materials/rope_law.hpp"

/// Friction of a rope that runs over its nodes, by the unstretched length each segment holds.
namespace talus::fem {

/// A rope at an instant: everything about it that friction depends on. Segments i = 0..m-1, inner nodes k =
/// 0..m-2 between segments k and k + 1.
struct RopeState {
  std::span<const double> lengths;  ///< m; current, all > 0
  std::span<const double> grips;    ///< exp(mu wrap angle) of each inner node, >= 1; infinite where clamped
};

/// Where material goes in a step, for every state: no iteration over sets of nodes that slip. Source: capstan
/// equation (Euler 1769) as a separable convex problem on a chain, solved by dynamic programming as
/// total-variation filters are (Johnson, J. Comput. Graph. Stat. 22 (2013)).
///
///     least of  sum_i G_i(ln N_i)   under  1/a_k <= N_(k+1)/N_k <= a_k,      dG_i/d ln N_i = M_i^old - M_i(N_i)
///     e_i(N) = M_i^old - M_i(N) + p_(i-1)(N)                             rises with N;  e_i(r_i) = 0
///     p_k(N) = e_k(a_k N) for N < r_k/a_k,   e_k(N/a_k) for N > a_k r_k,   0 between
///     N_(m-1) = r_(m-1),    N_k = r_k brought into [N_(k+1)/a_k, a_k N_(k+1)]
///
/// | symbol | variable  | meaning                                                                   | unit |
/// |--------|-----------|---------------------------------------------------------------------------|------|
/// | M_i    | material  | unstretched length that segment i holds at tension N: l_i/q(N) + M_i^old max(0, F/N - 1) | m |
/// | F      | floor     | 1e-13 E A, below any round-off of tensions                                | N    |
/// | a_k    | grip      | exp(mu theta_k)                                                           | 1    |
/// | e_i    | excess    | what segments 0..i have too much of if segment i had tension N             | m    |
/// | p_k    |           | what passes node k towards segment k + 1 in that case                      | m    |
/// | r_i    | root      | tension of segment i if the rope ended behind it                           | N    |
///
/// M_i(N) is all but straight for ropes under tension. So it is first replaced by its tangent, where e_i consists of
/// straight pieces and all roots are found in one sweep; two or three such sweeps arrive at round-off. Ropes that do
/// not (slack between clamps, or strained out of all proportion) get the roots of e_i itself. Below the floor a
/// segment is slack: the less its tension the more it holds, so that slack has one distribution, too, whatever the
/// order of the nodes. A rope that is slack as a whole (sum l_i <= q_0 sum M_i) has no friction: material moves as
/// little as makes every segment slack, in the sense of least squares. Proven by (elements_rope_chain.cpp): "a million random ropes end in the state that friction allows".
class RopeChain {
 public:
  /// Fills `material` and `slips` (m; towards the next segment positive; 0 at nodes that stick).
  /// @return false where a length or material is not a positive finite number
  bool solve(const RopeLaw& law, const RopeState& state, std::span<const double> old_material,
             std::span<double> material, std::span<double> slips);

 private:
  struct Problem {
    const RopeLaw& law;
    const RopeState& state;
    std::span<const double> old_material;
    double floor;  ///< N
  };
  struct Excess {
    double metres, slope;  ///< m, m/N
  };
  /// A corner of e_i: what its constant and slope change by when it is passed.
  struct Corner {
    double tension, constant, slope;  ///< N, m, m/N
  };
  static bool is_slack(const Problem& problem) noexcept;
  static void share_slack(const Problem& problem, std::span<double> material,
                          std::span<double> slips) noexcept;
  bool sweep_tangents(const Problem& problem) noexcept;
  bool roots_of_tangents(const Problem& problem) noexcept;
  void roots_of_excess(const Problem& problem) noexcept;
  void tensions_from_roots(const RopeState& state) noexcept;
  /// What segment k feels of the tension behind node k.
  struct Seen {
    bool slips;
    double tension, factor;  ///< N, and its derivative
  };
  Seen through_node(const RopeState& state, std::size_t node, double tension) const noexcept;
  static Excess held(const Problem& problem, std::size_t segment, double tension) noexcept;
  Excess excess(const Problem& problem, std::size_t last, double tension) const noexcept;
  double root(const Problem& problem, std::size_t last) const noexcept;
  void share_out(const Problem& problem, std::span<double> material, std::span<double> slips) noexcept;
  void settle_run(const Problem& problem, std::size_t first, std::size_t end) noexcept;

  std::vector<double> root_, tension_, before_;  ///< N
  std::vector<double> material_;                 ///< m; by the tensions
  std::vector<double> constant_, slope_;         ///< m, m/N; of the tangent to M_i^old - M_i(N)
  std::vector<Corner> left_, right_;             ///< of e_i on either side of its root, the nearest last
  std::vector<char> slips_;                      ///< whether each node slips
};

}  // namespace talus::fem
