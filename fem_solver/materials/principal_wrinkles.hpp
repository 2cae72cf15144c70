#pragma once

#include "fem_solver/materials/lanes.hpp"
#include "fem_solver/materials/plane_stress.hpp"

namespace talus::fem {

/// The wrinkled sheet after the paper: wrinkles stand across the smaller principal trial stress. Source: [P,
/// after eq. 14], Nakashino and Natori (2005):
///
///     n: direction of the smaller principal value of s = C d       U = (n_x^2, n_y^2, 2 n_x n_y)
///     stress = s - C U (U.s)/(U.C U)  =  C~ d,   C~ = C - (C U)(C U)^T/(U.C U)
///
/// | symbol | variable | meaning                                          | unit |
/// |--------|----------|--------------------------------------------------|------|
/// | s      | trial    | stress if the sheet could press                   | Pa   |
/// | d      | carried  | strain (xx, yy, 2 xy), prestress included         | 1    |
/// | U      | wrinkle  | wrinkle strain of unit size across the wrinkles   | 1    |
///
/// The stress across n vanishes. On isotropic sheets n is also the direction of the smaller strain, the shear
/// on it vanishes and the field equals ExactWrinkles. On orthotropic sheets the shear on n stays, which
/// leaves a smaller principal stress below zero, and the stress has **no potential**: its derivative is not
/// symmetric, so a closed cycle of strain does work. What energy_density returns is the energy stored with
/// the direction held, d.C~(n) d/2; it is never below the exact one, and its gradient is not the stress.
/// Proven by: "principal wrinkles of an orthotropic sheet have no potential" (elements_tension_field.cpp).
class PrincipalWrinkles {
 public:
  explicit PrincipalWrinkles(const PlaneElasticity& elasticity) : elasticity_(elasticity) {}

  template <class Real, class Mask>
  PlaneStress<Real> stress(const PlaneStrain<Real>&, const PlaneStress<Real>& trial,
                           const Mask&) const noexcept {
    const PlaneStrain<Real> U = wrinkle(trial);
    const PlaneStress<Real> CU = elasticity_.stress(U);
    const Real size = work(trial, U) / work(CU, U);
    return {trial.xx - size * CU.xx, trial.yy - size * CU.yy, trial.xy - size * CU.xy};
  }
  /// C (rate - (rate.C U)/(U.C U) U): what resists a strain rate along the tension.
  template <class Real, class Mask>
  PlaneStress<Real> rate_stress(const PlaneStrain<Real>&, const PlaneStress<Real>& trial,
                                const PlaneStrain<Real>& rate, const Mask&) const noexcept {
    const PlaneStrain<Real> U = wrinkle(trial);
    const PlaneStress<Real> CU = elasticity_.stress(U), taut = elasticity_.stress(rate);
    const Real size = work(CU, rate) / work(CU, U);
    return {taut.xx - size * CU.xx, taut.yy - size * CU.yy, taut.xy - size * CU.xy};
  }
  double energy_density(const PlaneStrain<double>& carried) const noexcept;
  /// d stress/d d with the turning of n; not symmetric on orthotropic sheets.
  PlaneMatrix tangent(const PlaneStrain<double>& carried) const noexcept;

 private:
  /// U across the wrinkles. Where both principal stresses are equal any direction is one of them.
  template <class Real>
  static PlaneStrain<Real> wrinkle(const PlaneStress<Real>& trial) noexcept {
    const Real difference = trial.xx - trial.yy, shear = 2 * trial.xy;
    const Real size = larger(square_root(difference * difference + shear * shear), Real(1e-300));
    const Real cosine = -difference / size, sine = -shear / size;  // of the doubled angle of n
    return {0.5 * (1 + cosine), 0.5 * (1 - cosine), sine};
  }

  PlaneElasticity elasticity_;
};

}  // namespace talus::fem
