#pragma once

#include <array>
#include <vector>

#include "coupler/participant.hpp"

/// Two participants small enough to be read at a glance: a mass on a spring to the ground (the structure, one
/// node), and a mass behind a contact spring (the particles). Together they are two masses and two springs,
/// which a test can compute undivided.
namespace talus::test {

struct TwoMasses {
  double structure_mass = 2;         ///< kg
  double structure_stiffness = 300;  ///< N/m, to the ground
  double particle_mass = 5;          ///< kg
  double contact_stiffness = 700;    ///< N/m, pushes only
  double gap = 0.01;                 ///< m, between the two at time 0
  double particle_velocity = -3;     ///< m/s, along z, towards the structure
};

/// Leapfrog of one degree of freedom: forces at t_n, velocity half a step behind.
struct Mass {
  double mass = 1, position = 0, velocity = 0;
  void advance(double force, double step) {
    velocity += step * (force / mass);
    position += step * velocity;
  }
};

/// Push of the contact spring on the particle; the structure feels its opposite.
inline double contact_force(const TwoMasses& system, double particle_position, double boundary_position) {
  const double overlap = boundary_position - particle_position;
  return overlap > 0 ? system.contact_stiffness * overlap : 0;
}

inline mesh::Surface one_node() {
  mesh::Surface surface;
  surface.positions = {0, 0, 0};
  return surface;
}

inline void serve_structure(coupler::Participant& participant, const TwoMasses& system) {
  participant.publish_surface(one_node(), std::array{system.structure_mass});
  participant.declare({.program = "spring", .step = 0, .limits = {}, .effects = {}, .outputs = {}});
  Mass node{.mass = system.structure_mass};
  Mass saved = node;
  for (auto command = participant.next(); command.action != coupler::Action::finish;
       command = participant.next()) {
    const auto fields = participant.structure_fields();
    if (command.action == coupler::Action::advance) {
      node.advance(fields.force[2] - system.structure_stiffness * node.position, command.length);
    }
    if (command.action == coupler::Action::save_state) saved = node;
    if (command.action == coupler::Action::restore_state) node = saved;
    fields.displacement[2] = node.position;
    fields.velocity[2] = node.velocity;
    participant.answer();
  }
}

inline void serve_particles(coupler::Participant& participant, const TwoMasses& system,
                            std::vector<double>* positions = nullptr) {
  std::vector<double> masses;
  participant.receive_surface(masses);
  participant.declare({.program = "mass", .step = 0, .limits = {}, .effects = {}, .outputs = {}});
  Mass particle{.mass = system.particle_mass, .position = system.gap, .velocity = system.particle_velocity};
  Mass saved = particle;
  for (auto command = participant.next(); command.action != coupler::Action::finish;
       command = participant.next()) {
    const auto fields = participant.particle_fields();
    if (command.action == coupler::Action::advance) {
      const double push = contact_force(system, particle.position, fields.start_displacement[2]);
      particle.advance(push, command.length);
      fields.force[2] = -push;
      if (positions != nullptr) positions->push_back(particle.position);
    }
    if (command.action == coupler::Action::save_state) saved = particle;
    if (command.action == coupler::Action::restore_state) particle = saved;
    participant.answer();
  }
}

}  // namespace talus::test
