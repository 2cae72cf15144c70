#include "coupler/schemes/exchange.hpp"

#include <algorithm>

#include "core/output/checkpoint.hpp"

namespace talus::coupler {
namespace {

using transport::ArrayName;

Exchange::Side side(Session& session, Role role) {
  Peer& peer = *session.find(role);
  return {.peer = peer,
          .force = peer.array(ArrayName::force),
          .displacement = peer.array(ArrayName::displacement),
          .velocity = peer.array(ArrayName::velocity),
          .end_displacement = peer.array(ArrayName::end_displacement),
          .end_velocity = peer.array(ArrayName::end_velocity),
          .free_velocity = peer.array(ArrayName::free_velocity),
          .moved_displacement = peer.array(ArrayName::moved_displacement),
          .moved_velocity = peer.array(ArrayName::moved_velocity),
          .lost = peer.array(ArrayName::lost)};
}

}  // namespace

Exchange::Exchange(Session& session, const mesh::Mapping& mapping)
    : session_(session),
      mapping_(mapping),
      structure_(side(session, Role::structure)),
      particles_(side(session, Role::particles)),
      one_set_(structure_.force.data() == particles_.force.data()) {}

Command Exchange::advance_of_particles(const Window& window, std::optional<int> iteration) const {
  Command command = advance(window, iteration);
  command.force_shift = structure_.peer.declaration().force_shift(window.length());
  return command;
}

void Exchange::advance_particles(const Window& window, std::optional<int> iteration) {
  session_.ask(particles_.peer, advance_of_particles(window, iteration));
}

void Exchange::advance_structure(const Window& window, std::optional<int> iteration) {
  session_.ask(structure_.peer, advance(window, iteration));
}

void Exchange::advance_both(const Window& window, std::optional<int> iteration) {
  session_.post(particles_.peer, advance_of_particles(window, iteration));
  session_.post(structure_.peer, advance(window, iteration));
  session_.wait_answer(particles_.peer);
  session_.wait_answer(structure_.peer);
}

void Exchange::save_states(const Window& window) {
  structure_start_.assign(structure_.displacement.begin(), structure_.displacement.end());
  structure_start_velocity_.assign(structure_.velocity.begin(), structure_.velocity.end());
  saved_length_ = window.length();
  force_start_.assign(particles_.force.begin(), particles_.force.end());
  session_.ask_all(command_at(window, Action::save_state));
}

void Exchange::restore_states(const Window& window) {
  session_.ask_all(command_at(window, Action::restore_state));
}

void Exchange::take_back(const Window& window) {
  restore_states(window);
  std::ranges::copy(force_start_, particles_.force.begin());
  losses_to_boundary();
}

bool Exchange::touching() const {
  return std::any_of(particles_.force.begin(), particles_.force.end(),
                     [](double value) { return value != 0; });
}

void Exchange::forces_to_structure() {
  if (one_set_) return;
  const bool touches = touching();
  if (touches || touched_) mapping_.to_structure(particles_.force, structure_.force);
  touched_ = touches;
}

void Exchange::motion_to_boundary() {
  if (one_set_) return;
  mapping_.to_boundary(structure_.displacement, particles_.displacement);
  mapping_.to_boundary(structure_.velocity, particles_.velocity);
  if (!structure_.free_velocity.empty())
    mapping_.to_boundary(structure_.free_velocity, particles_.free_velocity);
  losses_to_boundary();
}

void Exchange::losses_to_boundary() {
  std::ranges::copy(structure_.lost, particles_.lost.begin());
}

void Exchange::extrapolate_boundary_end(const Window& window) {
  if (particles_.end_displacement.empty()) return;
  for (std::size_t i = 0; i < particles_.displacement.size(); ++i) {
    particles_.end_displacement[i] = particles_.displacement[i] + window.length() * particles_.velocity[i];
  }
  std::copy(particles_.velocity.begin(), particles_.velocity.end(), particles_.end_velocity.begin());
}

void Exchange::release_structure() {
  std::ranges::fill(structure_.force, 0.0);
}

void Exchange::motion_to_boundary_end() {
  if (particles_.end_displacement.empty())
    return;  // they take one step, from the motion at the window's start
  mapping_.to_boundary(structure_.displacement, particles_.end_displacement);
  mapping_.to_boundary(structure_.velocity, particles_.end_velocity);
}

void Exchange::accept_window() {
  particles_.peer.work() +=
      work_of(particles_, {particles_.displacement, particles_.velocity}, particles_.end_displacement);
  structure_.peer.work() +=
      work_of(structure_, {structure_start_, structure_start_velocity_}, structure_.displacement);
  mapping_.to_boundary(structure_.displacement, particles_.displacement);
  mapping_.to_boundary(structure_.velocity, particles_.velocity);
  losses_to_boundary();
}

double Exchange::work_of(const Side& side, const WorkMeter::Motion& start,
                         std::span<const double> end) const {
  if (const auto told = side.peer.window_work()) return *told;
  const Declaration& declaration = side.peer.declaration();
  const bool at_start =
      declaration.force_use == ForceUse::kicks && !declaration.takes_several_steps(saved_length_);
  return WorkMeter({at_start ? ForceMeaning::at_start : ForceMeaning::mean, saved_length_}, side.force, start)
      .end(side.force, end);
}

void Exchange::archive(core::StateArchive& archive) {
  const auto array = [&archive](const std::string& name, std::span<double> values) {
    std::vector<double> copy(values.begin(), values.end());
    archive.values(name, copy);
    std::copy(copy.begin(), copy.end(), values.begin());
  };
  for (Side* side : {&structure_, &particles_}) {
    const std::string name = name_of(side->peer.role());
    array(name + "_force", side->force);
    array(name + "_displacement", side->displacement);
    array(name + "_velocity", side->velocity);
    array(name + "_end_displacement", side->end_displacement);
    array(name + "_end_velocity", side->end_velocity);
    array(name + "_free_velocity", side->free_velocity);
    array(name + "_lost", side->lost);
  }
  std::vector<double> works{work_on_structure(), work_on_boundary()};
  archive.values("works", works);
  structure_.peer.work() = works[0];
  particles_.peer.work() = works[1];
  std::int64_t touched = touched_ ? 1 : 0;
  archive.count("touched", touched);
  touched_ = touched != 0;
}

}  // namespace talus::coupler
