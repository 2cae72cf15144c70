#pragma once

#include "dem_solver/contact/law.hpp"
#include "dem_solver/contact/materials.hpp"
#include "dem_solver/particles/spheres.hpp"

namespace talus::dem {

/// Where a sphere meets something rigid: a plane, a wire, a triangle.
struct RigidTouch {
  Index sphere = 0;
  Triple<double> normal;            ///< unit vector towards the sphere's centre
  double overlap = 0;               ///< m; > 0 touching
  double reduced_radius = 0;        ///< m; the sphere's own, less where a wire is thin
  Triple<double> partner_velocity;  ///< m/s; of the contact point on the partner
  Triple<double> velocity_gain;     ///< m/s; of the sphere over the partner from t_n - step/2 to
                                    ///< t_n + step/2 where the contact is implicit, else zero
  const PairParameters* parameters = nullptr;
};

/// m; from the sphere's centre to the contact point.
inline double arm_of(const Spheres& spheres, const RigidTouch& at) noexcept {
  return spheres.position[at.sphere].w - at.overlap;
}

/// m/s; of the sphere over the partner at the contact point, half a step before the forces' time.
template <class Law>
Triple<double> relative_velocity(const Spheres& spheres, const RigidTouch& at) noexcept {
  Triple<double> velocity = triple<double>(spheres.velocity[at.sphere]) - at.partner_velocity;
  if constexpr (Law::has_friction)
    velocity = velocity - arm_of(spheres, at) * cross(triple<double>(spheres.spin[at.sphere]), at.normal);
  return velocity;
}

/// Adds the contact's load to the sphere. The partner is rigid in the law: m* = m, and the contact point lies
/// on its surface.
/// @return the force on the sphere, N
template <class Law>
Triple<double> evaluate_rigid_contact(Spheres& spheres, const RigidTouch& at, double step,
                                      typename Law::StoredMemory& stored, ContactWork& work) noexcept {
  const Row &p = spheres.position[at.sphere], &v = spheres.velocity[at.sphere];
  Touch<double> touch{.normal = at.normal,
                      .overlap = at.overlap,
                      .velocity = relative_velocity<Law>(spheres, at),
                      .travelled = {},
                      .spin = {},
                      .reduced_radius = at.reduced_radius,
                      .reduced_mass = v.w};
  if constexpr (Law::has_friction) touch.spin = triple<double>(spheres.spin[at.sphere]);
  if constexpr (Law::has_ledger) touch.travelled = touch.velocity;
  touch.velocity = touch.velocity + at.velocity_gain;
  if constexpr (Law::has_rolling) touch.reduced_inertia = 1.4 * v.w * p.w * p.w;

  typename Law::template Memory<double> memory;
  for (int k = 0; k < Law::memory_rows; ++k) memory[k] = stored[k];
  ContactLoss<double> loss;
  const ContactParameters<double> parameters{at.parameters->normal, at.parameters->friction,
                                             at.parameters->rolling};
  const ContactLoad<double> load = Law::evaluate(touch, parameters, step, memory, loss);
  for (int k = 0; k < Law::memory_rows; ++k) stored[k] = Row{memory[k]};

  add(spheres.force[at.sphere], load.force);
  if constexpr (Law::has_friction) {
    Triple<double> torque = arm_of(spheres, at) * cross(load.force, at.normal);
    if constexpr (Law::has_rolling) torque = torque + load.rolling_torque;
    add(spheres.torque[at.sphere], torque);
  }
  if constexpr (Law::has_ledger) work += {.damping = loss.damping, .friction = loss.friction};
  return load.force;
}

}  // namespace talus::dem
