#include "fem_solver/app/adapter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <variant>

#include "core/program/log.hpp"
#include "core/steps.hpp"
#include "coupler/scene/interface_scene.hpp"
#include "fem_solver/app/structure.hpp"
#include "fem_solver/constraints/held_directions.hpp"

namespace talus::fem {
namespace {

/// Names of the parts whose nodes the particles can touch; none in a scene without an interface.
std::vector<std::string> interface_parts(const core::SceneFile& file) {
  core::SceneReader reader(file);
  const auto scene = reader.optional<coupler::InterfaceScene>("interface");
  reader.finish();
  return scene ? scene->structure : std::vector<std::string>{};
}

/// Ω_S and the structure's node behind each of its own.
struct PublishedSurface {
  mesh::Surface surface;
  std::vector<Index> nodes;
  std::vector<double> masses;      ///< kg; infinite where the motion is prescribed
  std::vector<std::size_t> parts;  ///< numbers of its parts, in their order
};

const Part& find_part(const Model& model, const std::string& name) {
  const auto part = std::ranges::find(model.parts, name, &Part::name);
  if (part == model.parts.end())
    throw core::ConfigError(fmt::format("interface.structure: the structure has no part '{}'", name));
  return *part;
}

template <std::size_t N>
std::array<mesh::Index, N> renumbered(const std::array<Index, N>& cell, const std::vector<Index>& number) {
  std::array<mesh::Index, N> local;
  std::ranges::transform(cell, local.begin(),
                         [&](Index node) { return number[static_cast<std::size_t>(node)]; });
  return local;
}

void add_cells(const Part& part, const std::vector<Index>& number, mesh::Surface& surface) {
  mesh::SurfacePart& run = surface.parts.emplace_back();
  run.name = part.name;
  run.segment_begin = static_cast<mesh::Index>(surface.segments.size());
  run.triangle_begin = static_cast<mesh::Index>(surface.triangles.size());
  std::visit(
      [&](const auto& batch) {
        for (const auto& cell : batch.cells()) {
          constexpr std::size_t corners = std::tuple_size_v<std::decay_t<decltype(cell)>>;
          if constexpr (corners == 2) surface.segments.push_back(renumbered(cell, number));
          if constexpr (corners == 3) surface.triangles.push_back(renumbered(cell, number));
        }
      },
      part.elements);
  run.segment_end = static_cast<mesh::Index>(surface.segments.size());
  run.triangle_end = static_cast<mesh::Index>(surface.triangles.size());
}

/// @param start m; displacement at time 0, 3 a node of the model; empty: none
PublishedSurface published_surface(const Model& model, const std::vector<std::string>& parts,
                                   std::span<const double> start) {
  PublishedSurface published;
  std::vector<Index> number(static_cast<std::size_t>(model.nodes()), -1);
  const std::vector<bool> held = held_nodes(model);
  for (const auto& name : parts) {
    const Part& part = find_part(model, name);
    for (const Index node : part.nodes) {
      auto& own = number[static_cast<std::size_t>(node)];
      if (own >= 0) continue;
      own = static_cast<Index>(published.nodes.size());
      published.nodes.push_back(node);
      published.masses.push_back(held[static_cast<std::size_t>(node)]
                                     ? std::numeric_limits<double>::infinity()
                                     : model.node_masses[static_cast<std::size_t>(node)]);
      const Vector3 x = model.position(node);
      published.surface.positions.insert(published.surface.positions.end(), x.begin(), x.end());
      if (start.empty()) continue;
      const auto u = start.subspan(3 * static_cast<std::size_t>(node), 3);
      published.surface.start.insert(published.surface.start.end(), u.begin(), u.end());
    }
    add_cells(part, number, published.surface);
    published.parts.push_back(static_cast<std::size_t>(&part - model.parts.data()));
  }
  return published;
}

bool may_break(const Part& part) {
  return std::visit([](const auto& batch) { return Breaks<std::decay_t<decltype(batch)>>; }, part.elements);
}

/// 1 for each cell of Ω_S that has broken, segments before triangles. Only segments break.
void publish_losses(const Structure& structure, const PublishedSurface& published, std::span<double> lost) {
  if (lost.empty()) return;
  std::ranges::fill(lost, 0.0);
  std::size_t run = 0;
  const Model& model = structure.model();
  for (const std::size_t number : published.parts) {
    const mesh::SurfacePart& cells = published.surface.parts[run++];
    const Part& part = model.parts[number];
    const Configuration at = configuration_of(model, part, structure.integrator().state().configuration());
    std::visit(
        [&](const auto& batch) {
          if constexpr (Breaks<std::decay_t<decltype(batch)>>)
            for (Index e = 0; e < std::ssize(batch.cells()); ++e)
              lost[static_cast<std::size_t>(cells.segment_begin + e)] = batch.is_broken(at, e) ? 1 : 0;
        },
        part.elements);
  }
}

coupler::Declaration declaration(Structure& structure, const StructuralScene& scene,
                                 const PublishedSurface& published) {
  coupler::Declaration declared{
      .program = "fem_solver " + core::version(),
      .step = structure.step(),
      .insists_on_step = scene.structure.unstable_step == StructureScene::UnstableStep::allowed,
      .free_velocity = !structure.integrator().free_velocity(0, structure.step()).empty(),
      .loses_cells = std::ranges::any_of(
          published.parts, [&](std::size_t p) { return may_break(structure.model().parts[p]); }),
      .checkpoints = true,
      .force_use = structure.is_implicit() ? coupler::ForceUse::load : coupler::ForceUse::kicks,
      .limits = {},
      .effects = {},
      .outputs = structure.output().description(),
      .warnings = core::warnings_said()};
  for (const StepBound& bound : structure.bounds())
    declared.limits.push_back({bound.name, bound.seconds, true, bound.reason});
  for (const auto& effect : structure.effects(scene.structure))
    declared.effects.push_back({.name = effect.name,
                                .present = effect.present,
                                .reason = effect.reason,
                                .key = effect.key,
                                .ledger_line = effect.ledger_line,
                                .limit = effect.limit});
  return declared;
}

/// The present time, and the length of the window to come, in which something may touch.
struct Present {
  double time = 0, next_window = 0;  ///< s
};

void publish_motion(Integrator& integrator, const coupler::StructureFields& fields, const Present& present) {
  const InterfaceForce& interface = integrator.interface();
  interface.pick(integrator.displacement(), fields.displacement);
  interface.pick(integrator.velocity(), fields.velocity);
  if (!fields.free_velocity.empty())
    interface.pick(integrator.free_velocity(present.time, present.next_window), fields.free_velocity);
}

/// The work of the window's forces is told from this side's own ledger, except where a leapfrog takes one step
/// in a window that is never taken back: there the sum of forces and displacements is the same, and may be taken
/// for both sides at once.
void advance(const coupler::Command& command, Structure& structure, coupler::Participant& participant) {
  Integrator& integrator = structure.integrator();
  const double work_before = integrator.interface_work();
  integrator.interface().set(participant.structure_fields().force);
  integrator.advance(command.time, command.length);
  if (structure.is_implicit() || command.tentative || core::steps_in(command.length, structure.step()) > 1)
    participant.book_work(integrator.interface_work() - work_before);
  participant.tell_force_evaluations(integrator.force_evaluations());
}

/// A structure that finds equilibria knows no time: with particles beside it, nothing would move it.
void refuse_static(const core::SceneFile& file, const StructuralScene& scene) {
  if (file.has_section("particles") && std::holds_alternative<StaticScene>(scene.structure.method))
    throw core::ConfigError(
        "structure.static: a static structure has no time to go through together with `particles`; leave "
        "them "
        "out, or take `explicit` or `implicit`");
}

void obey(const coupler::Command& command, Structure& structure, const PublishedSurface& published,
          coupler::Participant& participant) {
  using coupler::Action;
  Integrator& integrator = structure.integrator();
  const coupler::StructureFields fields = participant.structure_fields();
  Present present{command.time, command.regular_length};
  switch (command.action) {
    case Action::advance:
      advance(command, structure, participant);
      present.time = command.time + command.length;
      break;
    case Action::save_state:
      return integrator.save();
    case Action::restore_state:
      integrator.restore();
      break;
    case Action::report:
      coupler::report(participant, command, structure.output());
      integrator.last_output_time = command.time;
      break;
    case Action::write_checkpoint:
      return coupler::write_checkpoint(
          command, [&](const std::filesystem::path& path) { structure.write_checkpoint(path); });
    case Action::read_checkpoint:
      structure.read_checkpoint(command.path);
      break;
    case Action::finish:
      return;
  }
  publish_motion(integrator, fields, present);
  publish_losses(structure, published, fields.lost);
}

}  // namespace

void serve_structure(const core::SceneFile& file, coupler::Participant& participant) {
  const StructuralScene scene = read_structural_scene(file);
  refuse_static(file, scene);
  Structure structure(scene);
  const bool displaced = scene.structure.start || !scene.structure.initial_displacements.empty();
  const std::span<const double> start =
      displaced ? std::span<const double>(structure.start().displacement) : std::span<const double>();
  const PublishedSurface published = published_surface(structure.model(), interface_parts(file), start);
  structure.make_interface(published.nodes);
  participant.publish_surface(published.surface, published.masses);
  participant.declare(declaration(structure, scene, published));
  for (auto command = participant.next(); command.action != coupler::Action::finish;
       command = participant.next()) {
    obey(command, structure, published, participant);
    participant.answer();
    structure.integrator().prepare();
  }
}

core::ExitCode run_coupled(const core::SolverCommand& command) {
  return coupler::take_part({.segment = command.join, .role = coupler::Role::structure},
                            [&](coupler::Participant& participant) {
                              serve_structure(core::SceneFile::load(command.scene), participant);
                            });
}

}  // namespace talus::fem
