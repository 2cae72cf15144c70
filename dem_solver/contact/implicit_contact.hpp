#pragma once

#include "dem_solver/boundary/boundary.hpp"
#include "dem_solver/contact/implicit_velocities.hpp"
#include "dem_solver/contact/rigid_contact.hpp"
#include "dem_solver/rocks/rocks.hpp"

namespace talus::dem {

/// What implicit contact needs besides the contacts themselves.
struct ImplicitContact {
  ImplicitVelocities::Control control;
  Triple<double> gravity;  ///< m/s^2
};

/// The contacts of one step and the bodies between them, for ImplicitVelocities.
class ImplicitSystem {
 public:
  struct Scene {
    const Spheres& spheres;
    const Rocks& rocks;
    std::span<const Index> place;  ///< where each sphere's id stands
    const Boundary& boundary;
  };
  /// Spheres and rocks with the loads they bear already, nodes with the velocity the structure gives them.
  /// @param which the spheres near the boundary
  void gather_bodies(const Scene& scene, std::span<const Index> which, const ImplicitContact& implicit,
                     double step);
  /// Ties a contact of the k-th of those spheres to its body.
  /// @param point m; where they touch, from the sphere's centre
  void tie(ImplicitVelocities::Contact& contact, Index k, const Triple<double>& point) const noexcept {
    contact.body = body_of_[k];
    contact.lever = offset_[k] + point;
    contact.saddle_lever = offset_[k];  // the force goes through the sphere's centre
  }
  /// @param velocity m/s; the relative velocity half a step before the forces' time
  void add(const ImplicitVelocities::Contact& contact, const Triple<double>& velocity) {
    contacts_.push_back(contact);
    velocity_before_.push_back(velocity);
  }
  int solve(double step, const ImplicitVelocities::Control& control) noexcept {
    return contacts_.empty() ? 0 : ImplicitVelocities::solve(contacts_, bodies_, step, control);
  }
  /// How much the relative velocity of a contact, in the order they were added, changes over the step.
  Triple<double> velocity_gain(std::size_t contact) const noexcept {
    return ImplicitVelocities::relative_velocity(contacts_[contact], bodies_) - velocity_before_[contact];
  }

 private:
  std::vector<ImplicitVelocities::Contact> contacts_;
  std::vector<Triple<double>> velocity_before_;
  ImplicitVelocities::Bodies bodies_;
  std::vector<Index> body_of_;          ///< of each sphere near the boundary
  std::vector<Triple<double>> offset_;  ///< m; of that sphere's centre from its body's
  std::vector<Index> body_of_rock_;     ///< -1: none of its spheres is near
};

/// The contact's springs and dashpots at the forces' time, as the system sees them.
template <class Law>
ImplicitVelocities::Contact springs_at_rest(const Spheres& spheres, const RigidTouch& at,
                                            const typename Law::StoredMemory& memory,
                                            const Triple<double>& guess) noexcept {
  const Touch<double> still{.normal = at.normal,
                            .overlap = at.overlap,
                            .velocity = {},
                            .travelled = {},
                            .spin = {},
                            .reduced_radius = at.reduced_radius,
                            .reduced_mass = spheres.velocity[at.sphere].w};
  const ContactParameters<double> parameters{at.parameters->normal, at.parameters->friction,
                                             at.parameters->rolling};
  const NormalForce<double> normal = Law::Normal::template force<double>(still, parameters);
  ImplicitVelocities::Contact contact{
      .normal = at.normal, .elastic = normal.elastic, .damping = normal.damping, .force = guess};
  if constexpr (Law::has_friction) {
    contact.tangential_stiffness = normal.tangential_stiffness;
    contact.tangential_damping = normal.tangential_damping;
    contact.spring =
        Law::Friction::spring_at_start(at.normal, normal.tangential_stiffness, Quad<double>(memory[0]));
    const Triple<double> v = relative_velocity<Law>(spheres, at);
    contact.coefficient = Law::Friction::limit(v - dot(v, at.normal) * at.normal, 1.0, parameters);
  }
  return contact;
}

}  // namespace talus::dem
