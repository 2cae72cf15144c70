#pragma once

#include <cmath>
#include <vector>

#include "coupler/participant.hpp"
#include "tests/support/two_masses.hpp"

/// A sphere that falls on one degree of freedom: the smallest impact on a light flexible structure. The
/// structure is integrated by the trapezoidal rule (Newmark, beta 1/4, gamma 1/2), once a window; the sphere
/// by a leapfrog in many steps, on a boundary that moves from the window's start to its end.
namespace talus::test {

struct SphereOnSpring {
  double sphere_mass = 100;          ///< kg
  double sphere_velocity = -8;       ///< m/s
  double structure_mass = 1;         ///< kg
  double structure_stiffness = 1e5;  ///< N/m, to the ground
  double contact_stiffness = 5e6;    ///< N/m, pushes only
  bool sticks = false;               ///< the contact spring pulls too: a linear problem
  int steps_a_window = 32;
};

inline double contact_force(const SphereOnSpring& system, double sphere, double boundary) {
  const double overlap = boundary - sphere;
  return overlap > 0 || system.sticks ? system.contact_stiffness * overlap : 0;
}

/// One degree of freedom under the trapezoidal rule, with the window's mean force:
///     v' = v + (L/m) (f - k (u + u')/2)      u' = u + L (v + v')/2
/// The mean belongs to the window's middle. Taken for the force at the window's end it would lag by half a
/// window, which feeds energy into the contact spring.
struct TrapezoidalMass {
  double mass = 1, stiffness = 0;
  double u = 0, v = 0;
  void advance(double mean_force, double length) {
    const double share = stiffness * length * length / (4 * mass);
    const double next =
        (u * (1 - share) + length * v + 0.5 * length * length * mean_force / mass) / (1 + share);
    v = 2 * (next - u) / length - v;
    u = next;
  }
  double energy() const { return 0.5 * mass * v * v + 0.5 * stiffness * u * u; }
};

inline void serve_structure(coupler::Participant& participant, const SphereOnSpring& system) {
  participant.publish_surface(one_node(), std::array{system.structure_mass});
  participant.declare({.program = "trapezoidal mass"});
  TrapezoidalMass node{.mass = system.structure_mass, .stiffness = system.structure_stiffness};
  TrapezoidalMass saved = node;
  for (auto command = participant.next(); command.action != coupler::Action::finish;
       command = participant.next()) {
    const auto fields = participant.structure_fields();
    if (command.action == coupler::Action::advance) node.advance(fields.force[2], command.length);
    if (command.action == coupler::Action::save_state) saved = node;
    if (command.action == coupler::Action::restore_state) node = saved;
    fields.displacement[2] = node.u;
    fields.velocity[2] = node.v;
    participant.answer();
  }
}

/// What a test wants to know of the sphere after each window that was computed.
struct SphereState {
  double position = 0, velocity = 0;
};

inline void serve_sphere(coupler::Participant& participant, const SphereOnSpring& system,
                         SphereState& sphere) {
  std::vector<double> masses;
  participant.receive_surface(masses);
  participant.declare({.program = "sphere", .step = 1e-12});  // always several steps a window
  sphere = {.position = 0, .velocity = system.sphere_velocity};
  SphereState saved = sphere;
  for (auto command = participant.next(); command.action != coupler::Action::finish;
       command = participant.next()) {
    const auto fields = participant.particle_fields();
    if (command.action == coupler::Action::save_state) saved = sphere;
    if (command.action == coupler::Action::restore_state) sphere = saved;
    if (command.action == coupler::Action::advance) {
      const double step = command.length / system.steps_a_window;
      double impulse = 0;
      for (int k = 0; k < system.steps_a_window; ++k) {
        const double share = (k + 0.5) / system.steps_a_window;
        const double boundary =
            (1 - share) * fields.start_displacement[2] + share * fields.end_displacement[2];
        // Position half a step ahead, where the force is taken: the symmetric form of the leapfrog.
        sphere.position += 0.5 * step * sphere.velocity;
        const double push = contact_force(system, sphere.position, boundary);
        sphere.velocity += step * push / system.sphere_mass;
        sphere.position += 0.5 * step * sphere.velocity;
        impulse += step * push;
      }
      fields.force[2] = -impulse / command.length;
    }
    participant.answer();
  }
}

/// The undivided system in a leapfrog of very small steps.
struct Undivided {
  double peak = 0;     ///< m, largest deflection of the structure
  double contact = 0;  ///< s, until the sphere leaves for good
};
inline Undivided undivided(const SphereOnSpring& system, double step) {
  SphereState sphere{.position = 0, .velocity = system.sphere_velocity};
  Mass node{.mass = system.structure_mass};
  Undivided result;
  for (double time = 0; sphere.position < 1e-3; time += step) {
    const double push = contact_force(system, sphere.position, node.position);
    if (push > 0) result.contact = time;
    node.advance(-push - system.structure_stiffness * node.position, step);
    sphere.velocity += step * push / system.sphere_mass;
    sphere.position += step * sphere.velocity;
    result.peak = std::max(result.peak, -node.position);
  }
  return result;
}

}  // namespace talus::test
