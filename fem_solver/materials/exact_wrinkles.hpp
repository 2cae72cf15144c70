#pragma once

#include "fem_solver/materials/lanes.hpp"
#include "fem_solver/materials/plane_stress.hpp"

namespace talus::fem {

/// The wrinkled sheet solved exactly: the energy is the least over all added wrinkle strains, so the stress
/// is uniaxial, free of compression, and the gradient of the energy. This is the field that iterating the
/// wrinkle direction converges to; here it is found from one scalar equation with one root.
///
/// By duality the least energy over wrinkle strains is the largest energy over uniaxial stresses q V(a):
///
///     w = max over a of h(a),   h = (V.d)^2/(2 V.S V),   V = (cos^2 a, sin^2 a, cos a sin a)
///     stress = (V.d)/(V.S V) V
///
/// Stretching y by r = (S11/S22)^(1/4) and doubling the angle of the stretched direction to p, h' = 0 becomes
///
///     g cos p - P sin p + K sin 2p = 0
///     d1 = d_xx,  d2 = r^2 d_yy,  g = r d_shear,  m = (S12 + S33/2)/sqrt(S11 S22)
///     P = (1 + m)/2 (d1 - d2),  K = (1 - m)/4 (d1 + d2)
///
/// and, for the sizes of g and P with their signs put back afterwards,
///
///     sin p = g/u,  cos p = P/(u + 2K):    |(g/u, P/(u + 2K))| = 1,    u > max(0, -2K)
///
/// h takes its maximum in the quadrant of p given by the signs of P and g, because reflecting p changes V.S V
/// not at all and V.d by 2 P cos p or 2 g sin p times a positive factor. In that quadrant the left side falls
/// strictly with u, so the root is unique; Newton's method on 1/|.|, concave and increasing, climbs to it
/// from max(|g|, |P| - 2K) without overshoot (the secular equation of trust-region methods, Conn, Gould,
/// Toint 2000, section 7.3). Isotropic sheets have m = 1, K = 0: exact after one step.
///
/// | symbol | variable    | meaning                                                | unit |
/// |--------|-------------|--------------------------------------------------------|------|
/// | d      | carried     | strain (xx, yy, 2 xy), prestress included               | 1    |
/// | S      | elasticity  | compliance                                              | 1/Pa |
/// | V      | direction   | stress of unit tension along a, up to a factor          | 1    |
/// | u      | root        | unknown of the secular equation                         | 1    |
///
/// Valid for every wrinkled d (neither taut nor slack) of a positive definite orthotropic sheet.
/// Proven by (elements_tension_field.cpp): "the exact tension field is the least energy over all wrinkle
/// strains".
class ExactWrinkles {
 public:
  explicit ExactWrinkles(const PlaneElasticity& elasticity);

  /// @param relevant lanes that are wrinkled; the others' results mean nothing
  template <class Real, class Mask>
  PlaneStress<Real> stress(const PlaneStrain<Real>& carried, const PlaneStress<Real>& trial,
                           const Mask& relevant) const noexcept;
  /// (V.rate)/(V.S V) V: what resists a strain rate along the tension.
  template <class Real, class Mask>
  PlaneStress<Real> rate_stress(const PlaneStrain<Real>& carried, const PlaneStress<Real>& trial,
                                const PlaneStrain<Real>& rate, const Mask& relevant) const noexcept;
  double energy_density(const PlaneStrain<double>& carried) const noexcept;
  /// d2w/dd2 = V V^T/D - h_da h_da^T/h_aa: symmetric, positive semidefinite.
  PlaneMatrix tangent(const PlaneStrain<double>& carried) const noexcept;

 private:
  /// Cosine and sine of the doubled angle p of the tension direction.
  template <class Real>
  struct DoubledAngle {
    Real cosine, sine;
  };
  template <class Real, class Mask>
  DoubledAngle<Real> tension_direction(const PlaneStrain<Real>& d, const Mask& relevant) const noexcept;

  PlaneElasticity elasticity_;
  double stretch_;         ///< r
  double stretch_square_;  ///< r^2
  double shape_;           ///< m; 1 for isotropic sheets, above -1 always
};

inline ExactWrinkles::ExactWrinkles(const PlaneElasticity& c)
    : elasticity_(c),
      stretch_(std::sqrt(std::sqrt(c.compliance_xx / c.compliance_yy))),
      stretch_square_(std::sqrt(c.compliance_xx / c.compliance_yy)),
      shape_((c.compliance_xy + 0.5 * c.compliance_shear) / std::sqrt(c.compliance_xx * c.compliance_yy)) {}

template <class Real, class Mask>
ExactWrinkles::DoubledAngle<Real> ExactWrinkles::tension_direction(const PlaneStrain<Real>& d,
                                                                   const Mask& relevant) const noexcept {
  // Common states need one to four steps; a million random sheets with moduli over four decades never needed
  // more than 15.
  constexpr int most_steps = 60;
  constexpr double closeness = 1e-9;  // of the last step; the error left is of the order of its square
  const Real d2 = stretch_square_ * d.yy, g = stretch_ * d.shear;
  const Real P = (0.5 * (1 + shape_)) * (d.xx - d2), K2 = (0.5 * (1 - shape_)) * (d.xx + d2);
  const Real g_size = magnitude_of(g), P_size = magnitude_of(P);
  Real u = larger(larger(g_size, P_size - K2), Real(1e-300));
  Mask climbing = relevant;  // a lane that has arrived stands still: its bits do not depend on its neighbours
  for (int step = 0; step < most_steps && any(climbing); ++step) {
    const Real inverse = 1 / u, inverse_shifted = 1 / (u + K2);
    const Real sine = g_size * inverse, cosine = P_size * inverse_shifted;
    const Real square = sine * sine + cosine * cosine;
    const Real climb =
        square * (square_root(square) - 1) / (sine * sine * inverse + cosine * cosine * inverse_shifted);
    u = select(climbing, u + climb, u);
    climbing = climbing && climb > closeness * select(K2 < 0, u + K2, u);
  }
  const Real sine = g_size / u, cosine = P_size / (u + K2), norm = square_root(sine * sine + cosine * cosine);
  return {signed_like(P, cosine / norm), signed_like(g, sine / norm)};
}

template <class Real, class Mask>
PlaneStress<Real> ExactWrinkles::stress(const PlaneStrain<Real>& d, const PlaneStress<Real>& trial,
                                        const Mask& relevant) const noexcept {
  return rate_stress(d, trial, d, relevant);
}

template <class Real, class Mask>
PlaneStress<Real> ExactWrinkles::rate_stress(const PlaneStrain<Real>& d, const PlaneStress<Real>&,
                                             const PlaneStrain<Real>& rate,
                                             const Mask& relevant) const noexcept {
  const DoubledAngle<Real> p = tension_direction(d, relevant);
  const PlaneStress<Real> V{1 + p.cosine, stretch_square_ * (1 - p.cosine), stretch_ * p.sine};
  const Real size = work(V, rate) / work(V, elasticity_.strain(V));
  return {size * V.xx, size * V.yy, size * V.xy};
}

}  // namespace talus::fem
