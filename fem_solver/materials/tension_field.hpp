#pragma once

#include <cstdint>

#include "fem_solver/materials/lanes.hpp"
#include "fem_solver/materials/plane_stress.hpp"

/// What a sheet does with a strain. A membrane law offers stress, energy_density, tangent and state; all take
/// the Green-Lagrange strain in material axes. Energies are zero at zero strain as long as the prestress is a
/// tension.
namespace talus::fem {

enum class SheetState : std::uint8_t { taut = 0, wrinkled = 1, slack = 2 };

/// Linear sheet that carries compression: s = C e + s_pre, w = e.C e/2 + s_pre.e, ds/de = C.
class LinearSheet {
 public:
  LinearSheet(const PlaneElasticity& elasticity, const PlaneStress<double>& prestress)
      : elasticity_(elasticity), prestress_(prestress) {}

  template <class Real>
  PlaneStress<Real> stress(const PlaneStrain<Real>& e) const noexcept {
    const PlaneStress<Real> s = elasticity_.stress(e);
    return {s.xx + prestress_.xx, s.yy + prestress_.yy, s.xy + prestress_.xy};
  }
  double energy_density(const PlaneStrain<double>& e) const noexcept {
    return elasticity_.energy_density(e) + work(prestress_, e);
  }
  PlaneMatrix tangent(const PlaneStrain<double>&) const noexcept { return elasticity_.stiffness(); }
  PlaneMatrix stiffest_tangent() const noexcept { return elasticity_.stiffness(); }
  SheetState state(const PlaneStrain<double>&) const noexcept { return SheetState::taut; }
  /// What resists a strain rate, per time: C rate. Pa for a rate in 1/s.
  template <class Real>
  PlaneStress<Real> rate_stress(const PlaneStrain<Real>&, const PlaneStrain<Real>& rate) const noexcept {
    return elasticity_.stress(rate);
  }

 private:
  PlaneElasticity elasticity_;
  PlaneStress<double> prestress_;
};

/// Sheet without compression: where the linear law would press, it wrinkles or goes slack. Source:
/// tension-field theory after Roddeman et al. (1987) and Nakashino and Natori (2005), [P, after eq. 14].
///
///     d = e + C^-1 s_pre      trial s = C d
///     taut      both principal values of s > 0:     stress s,    w = d.C d/2
///     slack     both principal values of d <= 0:    stress 0,    w = 0
///     wrinkled  else:                               stress and w by `Direction`
///
/// | symbol | variable | meaning                                                     | unit  |
/// |--------|----------|-------------------------------------------------------------|-------|
/// | e      | strain   | Green-Lagrange strain (xx, yy, 2 xy)                        | 1     |
/// | d      | carried  | strain with the prestress as a strain                       | 1     |
/// | s      | trial    | stress if the sheet could press; tension positive           | Pa    |
/// | w      | return   | energy per reference volume; returned less s_pre.C^-1 s_pre/2 | J/m^3 |
///
/// Direction = ExactWrinkles or PrincipalWrinkles: who knows the stress, energy and tangent of a wrinkled
/// sheet. Proven by: elements_tension_field.cpp.
template <class Direction>
class TensionField {
 public:
  TensionField(const PlaneElasticity& elasticity, const PlaneStress<double>& prestress)
      : elasticity_(elasticity),
        prestrain_(elasticity.strain(prestress)),
        prestress_energy_(elasticity.energy_density(prestrain_)),
        wrinkled_(elasticity) {}

  template <class Real>
  PlaneStress<Real> stress(const PlaneStrain<Real>& strain) const noexcept;
  double energy_density(const PlaneStrain<double>& strain) const noexcept;
  /// ds/de. Symmetric for ExactWrinkles; see PrincipalWrinkles.
  PlaneMatrix tangent(const PlaneStrain<double>& strain) const noexcept;
  /// The taut sheet's: what a wrinkled one may snap back to. The exact field's tangent never exceeds it.
  PlaneMatrix stiffest_tangent() const noexcept { return elasticity_.stiffness(); }
  SheetState state(const PlaneStrain<double>& strain) const noexcept;
  /// What resists a strain rate: C rate of a taut sheet, along its tension of a wrinkled one, nothing of a slack
  /// one. It never puts energy in.
  template <class Real>
  PlaneStress<Real> rate_stress(const PlaneStrain<Real>& strain,
                                const PlaneStrain<Real>& rate) const noexcept;

 private:
  template <class Real>
  PlaneStrain<Real> carried(const PlaneStrain<Real>& e) const noexcept {
    return {e.xx + prestrain_.xx, e.yy + prestrain_.yy, e.shear + prestrain_.shear};
  }

  PlaneElasticity elasticity_;
  PlaneStrain<double> prestrain_;
  double prestress_energy_;
  Direction wrinkled_;
};

/// Both principal stresses are positive; needs no square root.
template <class Real>
auto is_taut(const PlaneStress<Real>& s) noexcept {
  return s.xx + s.yy > 0 && s.xx * s.yy - s.xy * s.xy > 0;
}

/// Both principal strains are zero or negative.
template <class Real>
auto is_slack(const PlaneStrain<Real>& d) noexcept {
  return d.xx + d.yy <= 0 && 4 * (d.xx * d.yy) - d.shear * d.shear >= 0;
}

template <class Direction>
template <class Real>
PlaneStress<Real> TensionField<Direction>::stress(const PlaneStrain<Real>& strain) const noexcept {
  const PlaneStrain<Real> d = carried(strain);
  const PlaneStress<Real> trial = elasticity_.stress(d);
  const auto taut = is_taut(trial), slack = is_slack(d);
  const auto wrinkled = !(taut || slack);
  if (!any(wrinkled)) {
    const Real zero = 0;
    return {select(taut, trial.xx, zero), select(taut, trial.yy, zero), select(taut, trial.xy, zero)};
  }
  const PlaneStress<Real> relaxed = wrinkled_.stress(d, trial, wrinkled);
  const Real zero = 0;
  return {select(taut, trial.xx, select(slack, zero, relaxed.xx)),
          select(taut, trial.yy, select(slack, zero, relaxed.yy)),
          select(taut, trial.xy, select(slack, zero, relaxed.xy))};
}

template <class Direction>
template <class Real>
PlaneStress<Real> TensionField<Direction>::rate_stress(const PlaneStrain<Real>& strain,
                                                       const PlaneStrain<Real>& rate) const noexcept {
  const PlaneStrain<Real> d = carried(strain);
  const PlaneStress<Real> trial = elasticity_.stress(d), of_taut = elasticity_.stress(rate);
  const auto taut = is_taut(trial), slack = is_slack(d);
  const auto wrinkled = !(taut || slack);
  const PlaneStress<Real> along =
      any(wrinkled) ? wrinkled_.rate_stress(d, trial, rate, wrinkled) : PlaneStress<Real>{0, 0, 0};
  const Real zero = 0;
  return {select(taut, of_taut.xx, select(slack, zero, along.xx)),
          select(taut, of_taut.yy, select(slack, zero, along.yy)),
          select(taut, of_taut.xy, select(slack, zero, along.xy))};
}

template <class Direction>
SheetState TensionField<Direction>::state(const PlaneStrain<double>& strain) const noexcept {
  const PlaneStrain<double> d = carried(strain);
  if (is_taut(elasticity_.stress(d))) return SheetState::taut;
  return is_slack(d) ? SheetState::slack : SheetState::wrinkled;
}

template <class Direction>
double TensionField<Direction>::energy_density(const PlaneStrain<double>& strain) const noexcept {
  const PlaneStrain<double> d = carried(strain);
  switch (state(strain)) {
    case SheetState::taut:
      return elasticity_.energy_density(d) - prestress_energy_;
    case SheetState::slack:
      return -prestress_energy_;
    case SheetState::wrinkled:
      break;
  }
  return wrinkled_.energy_density(d) - prestress_energy_;
}

template <class Direction>
PlaneMatrix TensionField<Direction>::tangent(const PlaneStrain<double>& strain) const noexcept {
  switch (state(strain)) {
    case SheetState::taut:
      return elasticity_.stiffness();
    case SheetState::slack:
      return PlaneMatrix::Zero();
    case SheetState::wrinkled:
      break;
  }
  return wrinkled_.tangent(carried(strain));
}

}  // namespace talus::fem
