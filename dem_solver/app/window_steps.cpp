#include "dem_solver/app/window_steps.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "core/steps.hpp"

namespace talus::dem {

struct WindowSteps::Window {
  const coupler::ParticleFields& fields;
  Boundary::Motion motion;
  std::int64_t steps = 1;
  double step = 0;  ///< s

  bool end_is_known() const { return !motion.end_displacement.empty(); }
  double part(double steps_done) const { return steps_done / static_cast<double>(steps); }
};

WindowSteps::WindowSteps(ParticleSolver& solver, const Interface& interface, std::optional<double> longest)
    : solver_(solver),
      interface_(interface),
      longest_step_(longest),
      force_(interface.first_node, interface.node_masses.size()) {}

void WindowSteps::advance(const coupler::Command& command, const coupler::ParticleFields& fields) {
  const std::int64_t steps = longest_step_ ? core::steps_in(command.length, *longest_step_) : 1;
  const Window window{.fields = fields,
                      .motion = {fields.start_displacement, fields.start_velocity, fields.end_displacement,
                                 fields.end_velocity, command.length, interface_.first_node},
                      .steps = steps,
                      .step = command.length / static_cast<double>(steps)};
  if (!fields.lost.empty()) solver_.boundary().lose(interface_.cells, fields.lost);
  solver_.set_clock({.time = command.time, .step = window.step});
  force_.begin({command.length, steps, command.force_shift}, fields.force);
  if (!fields.moved_displacement.empty() && !light_nodes_)
    light_nodes_.emplace(interface_.node_masses, interface_.first_node);
  if (light_nodes_) light_nodes_->begin_window(force_.rest());
  for (std::int64_t k = 0; k < steps; ++k) {
    if (k == 0 && window.end_is_known()) note_place();
    move_boundary(solver_, window, k);
    solver_.step();
    collect(solver_, window, k);
    if (k == 0 && window.end_is_known()) book_jump(window);
    if (light_nodes_) light_nodes_->answer(solver_.boundary(), window.step);
  }
  force_evaluations_ += steps;
  if (force_.needs_end()) look_at_end(window);
  if (light_nodes_) tell_where_nodes_went(window);
  // Where one step follows the other, window by window, the motion at the end is no more than a prediction.
  const bool path_is_known = window.end_is_known() && (steps > 1 || force_.needs_end() || command.tentative);
  work_ = path_is_known ? std::optional(force_.work()) : std::nullopt;
}

void WindowSteps::move_boundary(ParticleSolver& solver, const Window& window, std::int64_t step) const {
  Boundary& boundary = solver.boundary();
  if (boundary.empty()) return;
  const auto done = static_cast<double>(step);
  boundary.move(window.motion, {.displacement = window.part(done), .velocity = window.part(done - 0.5)});
  if (light_nodes_) light_nodes_->displace(boundary);
  if (!window.fields.free_velocity.empty())
    boundary.set_free_velocity(window.fields.free_velocity, interface_.first_node);
}

void WindowSteps::note_place() {
  const auto place =
      solver_.boundary().displacement().subspan(3 * static_cast<std::size_t>(interface_.first_node));
  place_before_.assign(place.begin(), place.end());
}

/// A window may begin elsewhere than the last one was told it would end, and with another velocity. The path
/// since the last forces is then not step times velocity, on which their work is booked.
void WindowSteps::book_jump(const Window& window) {
  if (solver_.steps_done() == 1) return;  // no forces before
  const Boundary& boundary = solver_.boundary();
  double work = 0;
  for (const Index node : boundary.loaded_nodes()) {
    if (node < interface_.first_node) continue;
    const Row& reaction = boundary.reaction()[node];
    const double* now = boundary.displacement().data() + 3 * static_cast<std::size_t>(node);
    const double* before = place_before_.data() + 3 * static_cast<std::size_t>(node - interface_.first_node);
    const Triple<double> path{now[0] - before[0], now[1] - before[1], now[2] - before[2]};
    work += dot(triple<double>(reaction), path - window.step * boundary.velocity(node));
  }
  force_.add_work(0, work / window.step);
  solver_.book_boundary_work(-work);
}

void WindowSteps::collect(const ParticleSolver& solver, const Window& window, std::int64_t step) {
  const Boundary& boundary = solver.boundary();
  force_.add(boundary, step, [&](std::size_t node) {
    if (!window.end_is_known()) return Triple<double>{};
    const Triple<double> given = window.motion.velocity(node, window.part(static_cast<double>(step)));
    if (!light_nodes_) return given;
    const Row& reaction = boundary.reaction()[static_cast<std::size_t>(interface_.first_node) + node];
    return given + light_nodes_->velocity(node) +
           (0.5 * window.step * light_nodes_->inverse_mass(node)) * triple<double>(reaction);
  });
}

/// The forces at the window's end, of particles that have arrived there. Only they are wanted, so a copy of the
/// solver takes the step that begins with them.
void WindowSteps::look_at_end(const Window& window) {
  ahead_ = solver_;
  move_boundary(*ahead_, window, window.steps);
  ahead_->step();
  collect(*ahead_, window, window.steps);
  ++force_evaluations_;
}

void WindowSteps::tell_where_nodes_went(const Window& window) const {
  const coupler::ParticleFields& fields = window.fields;
  for (std::size_t i = 0; i < fields.force.size(); ++i) {
    fields.moved_displacement[i] = fields.end_displacement[i] + light_nodes_->displacement()[i];
    fields.moved_velocity[i] =
        fields.end_velocity[i] + window.motion.length * light_nodes_->inverse_mass(i / 3) * fields.force[i];
  }
}

void WindowSteps::save() {
  saved_.emplace(Saved{solver_, force_});
}

void WindowSteps::restore() {
  if (!saved_) throw core::UsageError("restore_state may not come before save_state");
  solver_ = saved_->solver;
  force_ = saved_->force;
}

}  // namespace talus::dem
