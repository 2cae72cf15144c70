#pragma once

#include "dem_solver/particles/row.hpp"

/// What a contact law sees of a contact, and what it gives back. Nothing here knows whether the partner is a
/// sphere, a plane or a wire.
namespace talus::dem {

/// A term that a scene does not call for: no instructions, no memory.
struct NoTerm {
  static constexpr int memory_rows = 0;
};

/// The contact of a sphere ("first") with a partner, at the time t_n of the force evaluation.
template <class Real>
struct Touch {
  Triple<Real> normal;     ///< unit vector from the partner to the first sphere
  Real overlap{};          ///< m; > 0 while touching
  Triple<Real> velocity;   ///< m/s; of the first relative to the partner, at the contact point, as the
                           ///< dashpots see it: at t_n - step/2, implicit contacts at t_n + step/2
  Triple<Real> travelled;  ///< m/s; the same over the step behind t_n; filled for laws with a ledger only
  Triple<Real> spin;       ///< rad/s; of the first relative to the partner
  Real reduced_radius{};   ///< m; R*
  Real reduced_mass{};     ///< kg; m*
  Real reduced_inertia{};  ///< kg m^2; about the contact point; filled for laws with rolling resistance only
  Real area{};             ///< m^2; of the surface behind the contact; filled for laws that spread over it
};

/// What a pair of materials means for each term, computed once per scene.
struct PairParameters {
  Row normal;    ///< see the normal law
  Row friction;  ///< see the friction law
  Row rolling;   ///< see the rolling law
};

/// The same, of one contact or of four at a time.
template <class Real>
struct ContactParameters {
  Quad<Real> normal, friction, rolling;
};

/// The normal force and what the other terms build on.
template <class Real>
struct NormalForce {
  Real elastic{};               ///< N; >= 0
  Real total{};                 ///< N; >= 0, dashpot included
  Real stiffness{};             ///< N/m; d(elastic)/d(overlap), the larger one where loading differs
  Real damping{};               ///< N s/m; of the dashpot
  Real tangential_stiffness{};  ///< N/m; 0 when apart
  Real tangential_damping{};    ///< N s/m
};

}  // namespace talus::dem
