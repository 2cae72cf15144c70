#pragma once

#include "dem_solver/contact/law.hpp"
#include "dem_solver/contact/materials.hpp"
#include "dem_solver/particles/spheres.hpp"

namespace talus::dem {

/// A sphere that meets something rigid, or four of them.
template <class Real>
struct RigidMeeting {
  Quad<Real> position, velocity;    ///< of the sphere; w: radius, mass
  Triple<Real> spin;                ///< rad/s; of the sphere; unused without friction
  Triple<Real> normal;              ///< unit vector towards the sphere's centre
  Real overlap{};                   ///< m; > 0 touching
  Real reduced_radius{};            ///< m; the sphere's own, less where a wire is thin
  Real area{};                      ///< m^2; of the sphere's surface; unused by laws of points
  Triple<Real> partner_velocity{};  ///< m/s; of the contact point on the partner
  Real arm{};                       ///< m; from the sphere's centre to the contact point
};

/// The partner is rigid in the law: m* = m, and the contact point lies on its surface.
template <class Law, class Real>
TALUS_INLINE Touch<Real> touch_of(const RigidMeeting<Real>& at) noexcept {
  Touch<Real> touch{};
  touch.normal = at.normal;
  touch.overlap = at.overlap;
  touch.velocity = triple(at.velocity) - at.partner_velocity;
  touch.reduced_radius = at.reduced_radius;
  touch.reduced_mass = at.velocity.w;
  if constexpr (Law::spreads_over_area) touch.area = at.area;
  if constexpr (Law::has_friction) {
    touch.spin = at.spin;
    touch.velocity = touch.velocity - at.arm * cross(at.spin, at.normal);
  }
  if constexpr (Law::has_ledger) touch.travelled = touch.velocity;
  if constexpr (Law::has_rolling) touch.reduced_inertia = 1.4 * at.velocity.w * at.position.w * at.position.w;
  return touch;
}

/// N m; on the sphere.
template <class Law, class Real>
TALUS_INLINE Triple<Real> torque_of(const RigidMeeting<Real>& at, const ContactLoad<Real>& load) noexcept {
  const Triple<Real> torque = at.arm * cross(load.force, at.normal);
  if constexpr (Law::has_rolling)
    return torque + load.rolling_torque;
  else
    return torque;
}

/// Where a sphere meets a wire or a triangle.
struct RigidTouch {
  Index sphere = 0;
  Triple<double> normal;            ///< unit vector towards the sphere's centre
  double overlap = 0;               ///< m; > 0 touching
  double arm = 0;                   ///< m; from the sphere's centre to the contact point
  double reduced_radius = 0;        ///< m; the sphere's own, less where a wire is thin
  double area = 0;                  ///< m^2; of the sphere's surface, less where a wire is thin
  Triple<double> partner_velocity;  ///< m/s; of the contact point on the partner
  Triple<double> velocity_gain;     ///< m/s; of the sphere over the partner from t_n - step/2 to
                                    ///< t_n + step/2 where the contact is implicit, else zero
  const PairParameters* parameters = nullptr;
  bool has_saddle = false;         ///< that limits the overlap and to which the sphere is drawn
  Triple<double> saddle_normal;    ///< unit vector towards the sphere's centre
  Triple<double> saddle_velocity;  ///< m/s; of the saddle
};

template <class Law>
RigidMeeting<double> meeting_of(const Spheres& spheres, const RigidTouch& at) noexcept {
  RigidMeeting<double> meeting{.position = spheres.position[at.sphere],
                               .velocity = spheres.velocity[at.sphere],
                               .spin = {},
                               .normal = at.normal,
                               .overlap = at.overlap,
                               .reduced_radius = at.reduced_radius,
                               .area = at.area,
                               .partner_velocity = at.partner_velocity,
                               .arm = at.arm};
  if constexpr (Law::has_friction) meeting.spin = triple<double>(spheres.spin[at.sphere]);
  return meeting;
}

/// The touch, whose overlap a saddle that moves away makes grow.
template <class Law>
Touch<double> touch_of(const Spheres& spheres, const RigidTouch& at) noexcept {
  Touch<double> touch = touch_of<Law>(meeting_of<Law>(spheres, at));
  if (!at.has_saddle) return touch;
  const Triple<double> over_saddle = triple<double>(spheres.velocity[at.sphere]) - at.saddle_velocity;
  touch.velocity = touch.velocity - dot(over_saddle, at.saddle_normal) * at.normal;
  if constexpr (Law::has_ledger) touch.travelled = touch.velocity;
  return touch;
}

/// m/s; of the sphere over the partner at the contact point, half a step before the forces' time.
template <class Law>
Triple<double> relative_velocity(const Spheres& spheres, const RigidTouch& at) noexcept {
  return touch_of<Law>(spheres, at).velocity;
}

/// N; on the sphere.
struct RigidForce {
  Triple<double> force;  ///< at the contact point
  Triple<double> pull;   ///< towards the saddle; zero without one
};

/// Adds the contact's load to the sphere.
template <class Law>
RigidForce evaluate_rigid_contact(Spheres& spheres, const RigidTouch& at, double step,
                                  typename Law::StoredMemory& stored, ContactWork& work) noexcept {
  const RigidMeeting<double> meeting = meeting_of<Law>(spheres, at);
  Touch<double> touch = touch_of<Law>(spheres, at);
  touch.velocity = touch.velocity + at.velocity_gain;

  typename Law::template Memory<double> memory;
  for (int k = 0; k < Law::memory_rows; ++k) memory[k] = stored[k];
  ContactLoss<double> loss;
  const ContactParameters<double> parameters{at.parameters->normal, at.parameters->friction,
                                             at.parameters->rolling};
  const ContactLoad<double> load = Law::evaluate(touch, parameters, step, memory, loss);
  for (int k = 0; k < Law::memory_rows; ++k) stored[k] = Row{memory[k]};

  add(spheres.force[at.sphere], load.force);
  spheres.force[at.sphere].w += load.stiffness;
  if constexpr (Law::has_friction) add(spheres.torque[at.sphere], torque_of<Law>(meeting, load));
  if constexpr (Law::has_ledger) work += {.damping = loss.damping, .friction = loss.friction};
  if (!at.has_saddle) return {load.force, {}};
  const Triple<double> pull = -dot(load.force, at.normal) * at.saddle_normal;
  add(spheres.force[at.sphere], pull);
  return {load.force, pull};
}

}  // namespace talus::dem
