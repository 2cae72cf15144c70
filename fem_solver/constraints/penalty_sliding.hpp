#pragma once

#include <Eigen/Core>

#include "fem_solver/constraints/nearest_segment.hpp"

namespace talus::fem {

/// A spring that holds a slider C on a rope segment A-B. Source: [P eq. 5, 6] with the derivatives of eq. 6;
/// eq. 7 as printed, alpha dd/du, lacks the factor d of the chain rule: the force of (alpha/2) d^2 is alpha d
/// dd/du.
///
///     w = B - A    r = C - A    t = r.w/w.w clamped to [0, 1]    q = r - t w    d = |q|
///     U = alpha d^2/2      f_C = alpha q      f_A = -(1 - t) f_C      f_B = -t f_C
///     between the ends:  dt = (w.dr + (q - t w).dw)/w.w,   dq = dr - t dw - w dt
///     at an end:         dt = 0,                           dq = dr - t dw
///     K from df_C = alpha dq,  df_A = -(1 - t) alpha dq + alpha q dt,  df_B = -t alpha dq - alpha q dt
///
/// | symbol | variable | meaning                                                                        | unit |
/// |--------|----------|--------------------------------------------------------------------------------|------|
/// | alpha  | penalty  | spring stiffness; the gap left is force/alpha, the step limit falls with it    | N/m  |
/// | t      | fraction | where C's foot stands; by it |v x w|/|w| of eq. 5 equals |q| between the ends  | 1    |
/// | d      | gap      | distance of the slider from the rope                                           | m    |
/// | f      |          | internal forces: what the nodes must be held with                              | N    |
///
/// Clamping makes the rope finite: a slider past its last node is pulled back to that node, and at a corner
/// it goes from one segment to the next where d is the same. Across a bend's inner side d^2 keeps its value
/// but not its slope; the jump in force is at most alpha d times the sine of the bend. Proven by
/// (elements_constraints.cpp): "the force of penalty sliding is the derivative of [P eq. 6]".
class PenaltySlide {
 public:
  struct Nodes {
    Vector3 A, B, C;  ///< m
  };
  /// @pre A and B differ
  PenaltySlide(const Nodes& nodes, double penalty) noexcept
      : penalty_(penalty), w_(nodes.B - nodes.A), fraction_(foot_fraction(nodes.A, nodes.B, nodes.C)) {
    q_ = nodes.C - nodes.A - fraction_ * w_;
  }

  double energy() const noexcept { return 0.5 * penalty_ * q_.squaredNorm(); }
  double gap() const noexcept { return q_.norm(); }
  double fraction() const noexcept { return fraction_; }
  /// Internal force on the slider; A has -(1 - fraction) of it, B -fraction.
  Vector3 slider_force() const noexcept { return penalty_ * q_; }

  using Matrix9 = Eigen::Matrix<double, 9, 9>;
  /// d(f_A, f_B, f_C)/d(A, B, C)
  Matrix9 stiffness() const noexcept;
  /// The same times changes of the nodes: changes of the forces.
  Nodes stiffness_product(const Nodes& changes) const noexcept;
  /// The part of it that resists a change of the gap, as a rate's force does.
  Nodes material_product(const Nodes& changes) const noexcept;
  Matrix9 material_stiffness() const noexcept;

 private:
  bool between_ends() const noexcept { return fraction_ > 0 && fraction_ < 1; }

  double penalty_;
  Vector3 w_, q_;
  double fraction_;
};

}  // namespace talus::fem
