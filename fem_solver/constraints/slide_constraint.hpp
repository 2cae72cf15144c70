#pragma once

#include <Eigen/Core>
#include <array>

#include "core/vector3.hpp"

namespace talus::fem {

using core::Vector3;

/// A slider C that stays on the straight line through rope nodes A and B, linearised at a state. Source: [P
/// eq. 8-13].
///
///     d = B - A    r = C - A    t = r_a/d_a    g_b = r_b - t d_b = 0  for the two directions b other than a
///     du_Cb = (1 - t) du_Ab + t du_Bb + (d_b/d_a) (du_Ca - (1 - t) du_Aa - t du_Ba) - g_b
///
/// | symbol | variable   | meaning                                                                  | unit |
/// |--------|------------|--------------------------------------------------------------------------|------|
/// | a      | pivot      | direction of the largest component of d; the case distinction of eq. 10  | -    |
/// | b      | slaves     | the directions in which C follows                                        | -    |
/// | t      | fraction   | where C stands between A (0) and B (1)                                   | 1    |
/// | g_b    | offsets    | how far C is off the line, measured along b; taken back by the next step | m    |
/// | du     |            | change of displacement from this state                                   | m    |
///
/// This is the full derivative of eq. 11. Eq. 13 as printed keeps d_X in the denominator fixed and takes t
/// from the reference state, so that forces carried over by its weights have a moment once the rope turns or
/// the slider has moved; with these weights force and moment are carried over exactly. Valid for A and B
/// apart, whatever their direction: |d_b/d_a| <= 1. Proven by (elements_constraints.cpp): "the weights of a
/// slide constraint carry force and moment over", "... are the derivative of [P eq. 11]".
struct SlideConstraint {
  struct Nodes {
    Vector3 A, B, C;  ///< m, current
  };
  /// @pre A and B differ
  explicit SlideConstraint(const Nodes& nodes) noexcept;

  /// One follower: C_slave = weights . masters + constant, all as changes of displacement.
  /// Masters in the order A_slave, B_slave, C_pivot, A_pivot, B_pivot.
  struct Row {
    int slave = 0;
    std::array<double, 5> weights{};
    double constant = 0;  ///< m
  };
  Row row(std::size_t follower) const noexcept;

  /// Condensation matrix of the nine displacements (A, B, C): full = L reduced + constant, where `reduced`
  /// has the seven that are free: A, B, C_pivot. So K^ = L^T K L and res^ = L^T res [P after eq. 13]:
  /// res_master += res_slave weight.
  using Condensation = Eigen::Matrix<double, 9, 7>;
  Condensation condensation() const noexcept;

  /// Sum over the followers of pull_b d2F_b/du2, where u_Cb = F_b(u) is the constraint itself:
  /// F_b = A_b + r_a d_b/d_a. Rows and columns: A, B, C. @param pulls on each follower (N)
  using Curvature = Eigen::Matrix<double, 9, 9>;
  Curvature curvature(const std::array<double, 2>& pulls) const noexcept;

  /// Distance of C from the line through A and B (m).
  double violation() const noexcept;

  int pivot = 0;
  std::array<int, 2> slaves{};
  double length = 0;  ///< d_a, m
  double fraction = 0;
  std::array<double, 2> slopes{};   ///< d_b/d_a of each follower
  std::array<double, 2> offsets{};  ///< g_b, m
};

}  // namespace talus::fem
