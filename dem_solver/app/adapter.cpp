#include "dem_solver/app/adapter.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"
#include "core/program/command_line.hpp"
#include "core/program/log.hpp"
#include "dem_solver/app/particle_run.hpp"
#include "dem_solver/app/window_steps.hpp"
#include "dem_solver/output/checkpoint.hpp"

namespace talus::dem {

namespace {

using coupler::Action;
using coupler::Command;

/// Ω_D behind the scene's own boundaries, which nothing moves.
struct CoupledBoundary {
  mesh::Surface surface;
  Index first_node = 0;             ///< of Ω_D
  Boundary::Cells cells;            ///< of Ω_D
  std::vector<double> node_masses;  ///< kg; of Ω_D
};

CoupledBoundary receive_boundary(const RunScene& scene, coupler::Participant& participant) {
  CoupledBoundary boundary;
  boundary.surface = make_surface(scene.particles.boundaries);
  boundary.first_node = boundary.surface.node_count();
  const std::size_t own_segments = boundary.surface.segments.size(),
                    own_triangles = boundary.surface.triangles.size();
  const mesh::Surface interface = participant.receive_surface(boundary.node_masses);
  if (interface.node_count() > 0 && interface.cell_count() == 0)
    throw core::ConfigError(
        fmt::format("interface.boundary: particles would touch none of its {} nodes, as they have no lines "
                    "or triangles between them",
                    interface.node_count()));
  append(boundary.surface, interface);
  boundary.cells = {.first_segment = own_segments,
                    .segments = boundary.surface.segments.size() - own_segments,
                    .first_triangle = own_triangles};
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
  declaration.warnings = core::warnings_said();
  for (const ParticleStepLimit& limit : run.limits)
    declaration.limits.push_back({limit.name, limit.seconds, limit.stability, limit.reason});
  for (const ParticleEffect& effect : effects_of(scene.particles, {has_interface, scene.output.has_value()}))
    declaration.effects.push_back({.name = effect.name,
                                   .present = effect.present,
                                   .reason = effect.reason,
                                   .key = effect.key,
                                   .ledger_line = effect.ledger_line,
                                   .may_hold = effect.may_hold,
                                   .limit = effect.limit});
  return declaration;
}

void advance(const Command& command, WindowSteps& steps, coupler::Participant& participant) {
  steps.advance(command, participant.particle_fields());
  if (steps.work()) participant.book_work(*steps.work());
  participant.tell_force_evaluations(steps.force_evaluations());
}

void obey(const Command& command, ParticleRun& run, WindowSteps& steps, coupler::Participant& participant) {
  const auto rest = [&](core::StateArchive& archive) { steps.archive(archive); };
  switch (command.action) {
    case Action::advance:
      return advance(command, steps, participant);
    case Action::save_state:
      return steps.save();
    case Action::restore_state:
      return steps.restore();
    case Action::report:
      return coupler::report(participant, command, run.output);
    case Action::write_checkpoint:
      return coupler::write_checkpoint(
          command, [&](const std::filesystem::path& path) { write_checkpoint(run.solver, path, rest); });
    case Action::read_checkpoint:
      return read_checkpoint(run.solver, command.path, rest);
    case Action::finish:
      break;
  }
}

}  // namespace

void serve_particles(const core::SceneFile& file, coupler::Participant& participant) {
  const RunScene scene = read_run_scene(file);
  const CoupledBoundary boundary = receive_boundary(scene, participant);
  ParticleRun run(scene, boundary.surface, boundary.node_masses);
  if (scene.particles.implicit_contact)
    run.solver.boundary().set_node_masses(boundary.node_masses, boundary.first_node);
  participant.declare(declaration_of(scene, run, !boundary.node_masses.empty()));
  WindowSteps steps(run.solver, {boundary.first_node, boundary.node_masses, boundary.cells}, own_step(scene));
  for (Command command = participant.next(); command.action != Action::finish; command = participant.next()) {
    obey(command, run, steps, participant);
    participant.answer();
  }
}

}  // namespace talus::dem
