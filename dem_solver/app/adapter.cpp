#include "dem_solver/app/adapter.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/errors.hpp"
#include "core/program/command_line.hpp"
#include "dem_solver/app/particle_run.hpp"
#include "dem_solver/boundary/light_nodes.hpp"
#include "dem_solver/output/checkpoint.hpp"

namespace talus::dem {

namespace {

using coupler::Action;
using coupler::Command;

/// Ω_D behind the scene's own boundaries, which nothing moves.
struct CoupledBoundary {
  mesh::Surface surface;
  Index first_node = 0;             ///< of Ω_D
  std::vector<double> node_masses;  ///< kg; of Ω_D
};

CoupledBoundary receive_boundary(const RunScene& scene, coupler::Participant& participant) {
  CoupledBoundary boundary;
  boundary.surface = make_surface(scene.particles.boundaries);
  boundary.first_node = boundary.surface.node_count();
  append(boundary.surface, participant.receive_surface(boundary.node_masses));
  return boundary;
}

coupler::Declaration declaration_of(const RunScene& scene, const ParticleRun& run, bool has_interface) {
  coupler::Declaration declaration;
  declaration.program = "dem_solver " + core::version();
  declaration.step = own_step(scene).value_or(0);
  declaration.insists_on_step = scene.particles.unstable_step == ParticlesScene::UnstableStep::allowed;
  declaration.free_velocity = scene.particles.implicit_contact.has_value() && has_interface;
  declaration.light_boundary = has_interface;
  declaration.checkpoints = true;
  declaration.outputs = run.output.description();
  for (const ParticleStepLimit& limit : run.limits)
    declaration.limits.push_back({limit.name, limit.seconds, limit.stability, limit.reason});
  for (const ParticleEffect& effect : effects_of(scene.particles, {has_interface, scene.output.has_value()}))
    declaration.effects.push_back({effect.name, effect.present, effect.reason});
  return declaration;
}

/// Answers the commands of one run.
class Server {
 public:
  Server(const RunScene& scene, ParticleRun& run, coupler::Participant& participant,
         const CoupledBoundary& boundary)
      : own_step_(own_step(scene)), run_(run), participant_(participant), boundary_(boundary) {}

  void serve() {
    for (Command command = participant_.next(); command.action != Action::finish;
         command = participant_.next()) {
      obey(command);
      participant_.answer();
    }
  }

 private:
  void obey(const Command& command) {
    switch (command.action) {
      case Action::advance:
        return advance(command);
      case Action::save_state:
        saved_ = run_.solver;
        return;
      case Action::restore_state:
        return restore();
      case Action::report:
        return coupler::report(participant_, command, run_.output);
      case Action::write_checkpoint:
        return coupler::write_checkpoint(
            command, [&](const std::filesystem::path& path) { write_checkpoint(run_.solver, path); });
      case Action::read_checkpoint:
        return read_checkpoint(run_.solver, command.path);
      case Action::finish:
        break;
    }
  }

  void restore() {
    if (!saved_) throw core::UsageError("restore_state may not come before save_state");
    run_.solver = *saved_;
  }

  /// One window: as many equal steps as the own step asks for, on a boundary that moves from the window's
  /// start to its end. The force handed back is the mean over the steps, which has the same impulse.
  void advance(const Command& command) {
    const auto fields = participant_.particle_fields();
    const std::int64_t steps =
        own_step_ ? static_cast<std::int64_t>(std::ceil(command.length / *own_step_ * (1 - 1e-12))) : 1;
    run_.solver.set_clock({.time = command.time, .step = command.length / static_cast<double>(steps)});
    std::ranges::fill(fields.force, 0.0);
    const Boundary::Motion motion{fields.start_displacement, fields.start_velocity, fields.end_displacement,
                                  fields.end_velocity, boundary_.first_node};
    const bool asked = !fields.moved_displacement.empty();
    if (asked && !light_nodes_) light_nodes_.emplace(boundary_.node_masses, boundary_.first_node);
    if (light_nodes_) light_nodes_->begin_window();
    for (std::int64_t k = 0; k < steps; ++k) {
      if (!run_.solver.boundary().empty())
        run_.solver.boundary().move(motion, static_cast<double>(k) / static_cast<double>(steps));
      if (light_nodes_) light_nodes_->displace(run_.solver.boundary());
      if (!fields.free_velocity.empty())
        run_.solver.boundary().set_free_velocity(fields.free_velocity, boundary_.first_node);
      run_.solver.step();
      if (light_nodes_) light_nodes_->answer(run_.solver.boundary(), run_.solver.step_length());
      add_reactions(fields.force, 1.0 / static_cast<double>(steps));
    }
    if (light_nodes_) tell_where_nodes_went(fields);
    force_evaluations_ += steps;
    participant_.tell_force_evaluations(force_evaluations_);
  }

  void tell_where_nodes_went(const coupler::ParticleFields& fields) const {
    const auto add = std::plus<>{};
    std::ranges::transform(fields.end_displacement, light_nodes_->displacement(),
                           fields.moved_displacement.begin(), add);
    std::ranges::transform(fields.end_velocity, light_nodes_->velocity(), fields.moved_velocity.begin(), add);
  }

  void add_reactions(std::span<double> force, double share) const {
    const Boundary& boundary = run_.solver.boundary();
    for (const Index node : boundary.loaded_nodes()) {
      if (node < boundary_.first_node) continue;
      const Row& r = boundary.reaction()[node];
      double* to = force.data() + 3 * static_cast<std::size_t>(node - boundary_.first_node);
      to[0] += share * r.x;
      to[1] += share * r.y;
      to[2] += share * r.z;
    }
  }

  std::optional<double> own_step_;
  ParticleRun& run_;
  coupler::Participant& participant_;
  const CoupledBoundary& boundary_;
  std::optional<LightNodes> light_nodes_;  ///< where the scheme asks for them
  std::optional<ParticleSolver> saved_;
  std::int64_t force_evaluations_ = 0;  ///< since the start
};

}  // namespace

void serve_particles(const core::SceneFile& file, coupler::Participant& participant) {
  const RunScene scene = read_run_scene(file);
  const CoupledBoundary boundary = receive_boundary(scene, participant);
  ParticleRun run(scene, boundary.surface, boundary.node_masses);
  if (scene.particles.implicit_contact)
    run.solver.boundary().set_node_masses(boundary.node_masses, boundary.first_node);
  participant.declare(declaration_of(scene, run, !boundary.node_masses.empty()));
  Server(scene, run, participant, boundary).serve();
}

}  // namespace talus::dem
