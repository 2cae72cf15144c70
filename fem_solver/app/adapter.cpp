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

/// Numbers of the parts that one of the scene has become.
std::vector<std::size_t> find_parts(const Model& model, const std::string& name) {
  std::vector<std::size_t> found;
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    if (model.parts[p].name == name || model.parts[p].scene_part == name) found.push_back(p);
  if (found.empty())
    throw core::ConfigError(fmt::format("interface.structure: the structure has no part '{}'", name));
  return found;
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
  run.wire_radius = part.wire_radius;
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

void add_node(const Model& model, Index node, std::span<const double> start, PublishedSurface& published) {
  published.nodes.push_back(node);
  const Vector3 x = model.position(node);
  published.surface.positions.insert(published.surface.positions.end(), x.begin(), x.end());
  if (start.empty()) return;
  const auto u = start.subspan(3 * static_cast<std::size_t>(node), 3);
  published.surface.start.insert(published.surface.start.end(), u.begin(), u.end());
}

/// @param start m; displacement at time 0, 3 a node of the model; empty: none
PublishedSurface published_surface(const Model& model, const std::vector<std::string>& names,
                                   std::span<const double> start) {
  PublishedSurface published;
  std::vector<Index> number(static_cast<std::size_t>(model.nodes()), -1);
  for (const auto& name : names)
    for (const std::size_t p : find_parts(model, name)) {
      const Part& part = model.parts[p];
      for (const Index node : part.nodes) {
        auto& own = number[static_cast<std::size_t>(node)];
        if (own >= 0) continue;
        own = static_cast<Index>(published.nodes.size());
        add_node(model, node, start, published);
      }
      add_cells(part, number, published.surface);
      published.parts.push_back(p);
    }
  const std::vector<bool> held = held_nodes(model);
  for (const Index node : published.nodes) {
    const auto place = static_cast<std::size_t>(node);
    published.masses.push_back(held[place] ? std::numeric_limits<double>::infinity()
                                           : model.node_masses[place]);
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
              lost[static_cast<std::size_t>(cells.segment_begin + e)] =
                  batch.is_broken(at, element_of(batch, e)) ? 1 : 0;
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
