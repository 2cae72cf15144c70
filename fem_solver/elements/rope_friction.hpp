#pragma once

#include <span>
#include <vector>

#include "fem_solver/elements/rope_chain.hpp"

namespace talus::fem {

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
/// loses is the friction's dissipation, never negative. Solved by RopeChain; here
/// are what is quick (nothing slips) and the derivative. Proven by: elements_friction.cpp.
class RopeFriction {
 public:
  /// Room for ropes of so many segments; kept for the next.
  void resize(std::size_t segments);

  /// Fills `material` from `old_material` (which may be the same memory).
  /// @pre resize() to this rope
  /// @return false where a length or material is not a positive finite number; `material` then means nothing
  bool settle(const RopeLaw& law, const RopeState& state, std::span<const double> old_material,
              std::span<double> material);

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

  void evaluate(const RopeLaw& law, const RopeState& state, std::span<const double> material) noexcept;
  bool within_limits(const RopeState& state) const noexcept;
  void assemble(const RopeState& state) noexcept;
  void solve_tridiagonal() noexcept;

  std::vector<double> tension_, slope_;  ///< N and dN/dM of each segment
  std::vector<double> slip_;             ///< s_k
  std::vector<Motion> motion_;           ///< of each inner node
  std::vector<double> lower_, diagonal_, upper_,
      right_;  ///< tridiagonal system of the slips; right_ holds its solution
  RopeChain chain_;
};

}  // namespace talus::fem
