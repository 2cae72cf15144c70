#pragma once

#include "dem_solver/contact/touch.hpp"

/// Rolling resistance: a torque that opposes the relative rolling (not the twist about the normal) [Ai, Chen,
/// Rotter, Ooi, Powder Technol. 206 (2011) 269]. It acts on the first sphere and, reversed, on the partner.
namespace talus::dem {

/// The part of the relative spin that rolls.
template <class Real>
TALUS_INLINE Triple<Real> rolling_velocity(const Touch<Real>& touch) noexcept {
  return touch.spin - dot(touch.spin, touch.normal) * touch.normal;
}

/// Constant directional torque, their type A (eq. 5):  M = -mu_r R* Fn w/|w|.
///     mu_r · rolling friction coefficient · 1 · parameters.rolling.x
///     w    · relative rolling velocity    · rad/s
/// The torque never reverses the rolling within a step: it is limited to the one that stops it, I w/step.
/// Without that limit a resting sphere rocks for ever (their figure 5). Tests: "Rolling resistance of either
/// kind slows a rolling sphere by 5/7 mu_r g", "A constant rolling torque brings a sphere to rest without
/// rocking it".
struct ConstantTorque {
  static constexpr int memory_rows = 0;

  template <class Real>
  TALUS_INLINE static Triple<Real> torque(const Touch<Real>& touch, const NormalForce<Real>& normal,
                                          const ContactParameters<Real>& p, double step,
                                          Quad<Real>*) noexcept {
    const Real none{}, tiny = none + 1e-300;
    const Triple<Real> w = rolling_velocity(touch);
    const Real speed = square_root(dot(w, w));
    const Real limit = p.rolling.x * touch.reduced_radius * normal.total;
    const Real stopping =
        touch.reduced_inertia * speed / (step > 0 ? step : 1e-300);  // at a start none is behind
    return (-smaller(limit, stopping) / larger(speed, tiny)) * w;
  }
};

/// Elastic-plastic spring-dashpot, their type C (eq. 17-24):  M = Mk + Md,
///     Mk <- Mk - kr w step, limited to mu_r R* Fn;   kr = 2.25 kn (mu_r R*)^2 (three dimensions)
///     Md = -2 g_r sqrt(I kr) w  while Mk is below its limit, else 0
///     mu_r · rolling friction coefficient         · 1       · parameters.rolling.x
///     g_r  · viscous rolling damping ratio        · 1       · parameters.rolling.y
///     kn   · normal tangent stiffness             · N/m     · of the normal law
///     I    · reduced inertia about the contact    · kg m^2
///     Mk   · spring torque on the first sphere    · N m     · memory x y z; turned with the contact plane
/// Tests: "The elastic rolling spring rocks a sphere at its own frequency and damping", "Elastic-plastic
/// rolling resistance holds a sphere on a slope below mu_r and lets it roll above".
struct ElasticPlasticRolling {
  static constexpr int memory_rows = 1;

  template <class Real>
  TALUS_INLINE static Triple<Real> torque(const Touch<Real>& touch, const NormalForce<Real>& normal,
                                          const ContactParameters<Real>& p, double step,
                                          Quad<Real>* memory) noexcept {
    const Real none{}, tiny = none + 1e-300;
    const Triple<Real> w = rolling_velocity(touch);
    const Real arm = p.rolling.x * touch.reduced_radius;
    const Real limit = arm * normal.total;
    const Real kr = 2.25 * normal.stiffness * arm * arm;
    const Triple<Real> old = triple(*memory);
    const Triple<Real> spring = old - dot(old, touch.normal) * touch.normal - (kr * step) * w;
    const Real size = square_root(dot(spring, spring));
    const auto yields = size > limit;
    const Triple<Real> held = select(yields, (limit / larger(size, tiny)) * spring, spring);
    *memory = quad(held, none);
    const Real damping = yields ? none : 2.0 * p.rolling.y * square_root(touch.reduced_inertia * kr);
    return held - damping * w;
  }
};

}  // namespace talus::dem
