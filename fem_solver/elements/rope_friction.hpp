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
  std::span<const double> grips;    ///< exp(mu wrap angle) of each inner node, >= 1
};

/// Where material goes in a step. Source: capstan equation (Euler 1769) at every inner node at once, fully
/// implicit.
///
///     N_i = N(l_i/M_i)      M_i = M_i^old + s_(i-1) - s_i
///     s_k = 0:  1/a_k <= N_(k+1)/N_k <= a_k      s_k > 0:  N_(k+1) = a_k N_k      s_k < 0:  N_k = a_k
///     N_(k+1)
///
/// | symbol | variable  | meaning                                                               | unit |
/// |--------|-----------|-----------------------------------------------------------------------|------|
/// | M_i    | material  | unstretched length held by segment i; their sum is the rope's         | m    |
/// | s_k    | slip      | unstretched length that passes node k towards segment k + 1           | m    |
/// | a_k    | grip      | exp(mu theta_k), theta_k the angle between the segments               | 1    |
///
/// With -ln N as the slope of a convex potential of M_i these are the conditions of the least of
/// sum_i P_i(M_i) + sum_k mu theta_k |s_k|, strictly convex: the solution is unique, so it depends on no
/// order of the nodes. Material moves towards the larger tension only, so the elastic energy falls: what it
/// loses is the friction's dissipation, never negative. A rope slack as a whole (sum l_i <= q_0 sum M_i) has
/// no friction: material moves as little as makes every segment slack, in the sense of least squares. Solved
/// by Newton's method on the nodes that slip (tridiagonal), the set of which follows from each step. Proven
/// by: elements_friction.cpp.
class RopeFriction {
 public:
  explicit RopeFriction(std::size_t segments);

  /// Fills `material` from `old_material` (which may be the same memory). Does not allocate.
  /// @return false where Newton's method did not converge; `material` then means nothing
  bool settle(const RopeLaw& law, const RopeState& state, std::span<const double> old_material,
              std::span<double> material) noexcept;

  /// Slip of each inner node in the last settle(): towards the next segment positive, m.
  std::span<const double> slips() const noexcept { return slip_; }

  /// Changes of the tensions in the last settled state along changes of lengths and grips (N).
  /// @pre `state` and `material` are those of the last settle()
  struct Changes {
    std::span<const double> lengths;  ///< m
    std::span<const double> grips;    ///< 1
  };
  void tension_changes(const RopeLaw& law, const RopeState& state, std::span<const double> material,
                       const Changes& changes, std::span<double> tension_changes) noexcept;

 private:
  enum class Motion : signed char { backward = -1, stuck = 0, forward = 1 };

  void settle_slack(const RopeLaw& law, const RopeState& state, std::span<const double> old_material,
                    std::span<double> material) noexcept;
  bool solve(const RopeLaw& law, const RopeState& state, std::span<double> material) noexcept;
  void start_without_friction(const RopeState& state, std::span<const double> old_material,
                              std::span<double> material) noexcept;
  void settle_nodes_in_turn(const RopeLaw& law, const RopeState& state, std::span<double> material) noexcept;
  void pass(std::size_t node, double slip, std::span<double> material) noexcept;
  void evaluate(const RopeLaw& law, const RopeState& state, std::span<const double> material) noexcept;
  bool within_limits(const RopeState& state) const noexcept;
  bool settled(const RopeState& state, double tolerance) const noexcept;
  void predict_motion(const RopeState& state) noexcept;
  void assemble(const RopeState& state) noexcept;
  void solve_tridiagonal() noexcept;
  double stiffest(std::span<const double> material) const noexcept;
  double longest_step(std::span<const double> material) const noexcept;

  std::vector<double> tension_, slope_;  ///< N and dN/dM of each segment
  std::vector<double> slip_;             ///< s_k
  std::vector<Motion> motion_;           ///< of each inner node
  std::vector<double> lower_, diagonal_, upper_,
      right_;  ///< tridiagonal system of the slips; right_ holds its solution
  std::vector<double> swept_material_, swept_slip_;
};

}  // namespace talus::fem
