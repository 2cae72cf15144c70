#include "coupler/schemes/exchange.hpp"

#include <algorithm>

namespace talus::coupler {

using transport::ArrayName;

namespace {

bool all_zero(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return value == 0; });
}

}  // namespace

Command advance(const Window& window, int iteration) {
  return {.action = Action::advance,
          .window = window.index,
          .iteration = iteration,
          .time = window.start(),
          .length = window.length};
}

Exchange::Side Exchange::side(Session& session, Role role) {
  Peer& peer = *session.find(role);
  return {.peer = peer,
          .force = peer.array(ArrayName::force),
          .displacement = peer.array(ArrayName::displacement),
          .velocity = peer.array(ArrayName::velocity),
          .end_displacement = peer.array(ArrayName::end_displacement),
          .end_velocity = peer.array(ArrayName::end_velocity),
          .free_velocity = peer.array(ArrayName::free_velocity)};
}

Exchange::Exchange(Session& session, const mesh::Mapping& mapping)
    : session_(session),
      mapping_(mapping),
      structure_(side(session, Role::structure)),
      particles_(side(session, Role::particles)) {}

void Exchange::advance_particles(const Window& window, int iteration) {
  session_.ask(particles_.peer, advance(window, iteration));
}

void Exchange::advance_structure(const Window& window, int iteration) {
  session_.ask(structure_.peer, advance(window, iteration));
}

void Exchange::forces_to_structure() {
  const bool touched = touching_;
  touching_ = !all_zero(particles_.force);
  if (!touching_ && !touched) return;
  mapping_.to_structure(particles_.force, structure_.force);
  boundary_work_.begin(particles_.force, particles_.displacement);
  structure_work_.begin(structure_.force, structure_.displacement);
}

void Exchange::motion_to_boundary() {
  mapping_.to_boundary(structure_.displacement, particles_.displacement);
  mapping_.to_boundary(structure_.velocity, particles_.velocity);
  if (!structure_.free_velocity.empty())
    mapping_.to_boundary(structure_.free_velocity, particles_.free_velocity);
  structure_work_.end(structure_.displacement);
  boundary_work_.end(particles_.end_displacement.empty() ? particles_.displacement
                                                         : particles_.end_displacement);
}

void Exchange::extrapolate_boundary_end(const Window& window) {
  if (particles_.end_displacement.empty()) return;
  for (std::size_t i = 0; i < particles_.displacement.size(); ++i) {
    particles_.end_displacement[i] = particles_.displacement[i] + window.length * particles_.velocity[i];
  }
  std::copy(particles_.velocity.begin(), particles_.velocity.end(), particles_.end_velocity.begin());
}

}  // namespace talus::coupler
