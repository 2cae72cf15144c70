#include "dem_solver/contact/implicit_contact.hpp"

namespace talus::dem {

namespace {

using Bodies = ImplicitVelocities::Bodies;

Index add_sphere(Bodies& bodies, const Spheres& spheres, Index i, const ImplicitContact& implicit,
                 double step) {
  const double radius = spheres.position[i].w, inverse_mass = 1 / spheres.velocity[i].w;
  const Triple<double> gain = step * (inverse_mass * triple<double>(spheres.force[i]) + implicit.gravity);
  bodies.velocity.push_back(row(triple<double>(spheres.velocity[i]) + gain, inverse_mass));
  bodies.spin.emplace_back();
  bodies.inverse_inertia.emplace_back();
  if (spheres.rotates()) {
    const double inverse = inverse_mass / (0.4 * radius * radius);
    bodies.spin.back() =
        triple<double>(spheres.spin[i]) + (step * inverse) * triple<double>(spheres.torque[i]);
    bodies.inverse_inertia.back() = {{inverse, 0, 0}, {0, inverse, 0}, {0, 0, inverse}};
  }
  return static_cast<Index>(bodies.velocity.size()) - 1;
}

Index add_rock(Bodies& bodies, const ImplicitSystem::Scene& scene, Index k, const ImplicitContact& implicit,
               double step) {
  const Rocks& rocks = scene.rocks;
  const Rocks::Load load = rocks.load(k, scene.spheres, scene.place);
  const double inverse_mass = 1 / rocks.mass(k);
  bodies.velocity.push_back(
      row(rocks.velocity(k) + step * (inverse_mass * load.force + implicit.gravity), inverse_mass));
  bodies.spin.push_back(rocks.spin_of(k, rocks.angular_momentum(k) + step * load.torque));
  bodies.inverse_inertia.push_back(
      {rocks.spin_of(k, {1, 0, 0}), rocks.spin_of(k, {0, 1, 0}), rocks.spin_of(k, {0, 0, 1})});
  return static_cast<Index>(bodies.velocity.size()) - 1;
}

}  // namespace

void ImplicitSystem::gather_bodies(const Scene& scene, std::span<const Index> which,
                                   const ImplicitContact& implicit, double step) {
  contacts_.clear();
  velocity_before_.clear();
  bodies_.velocity.clear();
  bodies_.spin.clear();
  bodies_.inverse_inertia.clear();
  body_of_.clear();
  offset_.clear();
  body_of_rock_.assign(static_cast<std::size_t>(scene.rocks.size()), -1);
  const Spheres& spheres = scene.spheres;
  for (const Index i : which) {
    if (!spheres.in_rock(i)) {
      body_of_.push_back(add_sphere(bodies_, spheres, i, implicit, step));
      offset_.emplace_back();
      continue;
    }
    const Index k = spheres.rock[i];
    if (body_of_rock_[k] < 0) body_of_rock_[k] = add_rock(bodies_, scene, k, implicit, step);
    body_of_.push_back(body_of_rock_[k]);
    offset_.push_back(triple<double>(spheres.position[i]) - scene.rocks.centre(k));
  }
  bodies_.node_velocity.assign(scene.boundary.free_velocity().begin(), scene.boundary.free_velocity().end());
}

}  // namespace talus::dem
