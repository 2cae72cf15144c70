#include "dem_solver/contact/implicit_contact.hpp"

namespace talus::dem {

void ImplicitSystem::gather_bodies(const Spheres& spheres, std::span<const Index> which,
                                   const Boundary& boundary, const ImplicitContact& implicit, double step) {
  contacts_.clear();
  velocity_before_.clear();
  bodies_.velocity.clear();
  bodies_.spin.clear();
  for (const Index i : which) {
    const double radius = spheres.position[i].w, inverse_mass = 1 / spheres.velocity[i].w;
    const Triple<double> gain = step * (inverse_mass * triple<double>(spheres.force[i]) + implicit.gravity);
    bodies_.velocity.push_back(row(triple<double>(spheres.velocity[i]) + gain, inverse_mass));
    if (!spheres.rotates()) continue;
    const double inverse_inertia = inverse_mass / (0.4 * radius * radius);
    bodies_.spin.push_back(
        row(triple<double>(spheres.spin[i]) + (step * inverse_inertia) * triple<double>(spheres.torque[i]),
            inverse_inertia));
  }
  bodies_.node_velocity.assign(boundary.free_velocity().begin(), boundary.free_velocity().end());
}

}  // namespace talus::dem
