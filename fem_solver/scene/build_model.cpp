#include "fem_solver/scene/build_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/errors.hpp"
#include "core/program/log.hpp"
#include "core/units/units.hpp"
#include "fem_solver/constraints/held_directions.hpp"
#include "fem_solver/scene/bar_chains.hpp"
#include "fem_solver/scene/loose_ends.hpp"
#include "fem_solver/scene/make_elements.hpp"
#include "fem_solver/scene/masses.hpp"
#include "fem_solver/scene/mesh_groups.hpp"
#include "fem_solver/scene/node_sets.hpp"
#include "fem_solver/scene/rope_order.hpp"
#include "fem_solver/scene/unheld_parts.hpp"
#include "fem_solver/scene/weld.hpp"
#include "interface_mesh/surface_checks.hpp"

namespace talus::fem {
namespace {

/// A part between being meshed and becoming a batch: elements by the model's node numbers.
struct MeshedPart {
  std::string name, scene_name;
  const PartScene* scene = nullptr;
  std::vector<std::array<Index, 2>> segments{};
  std::vector<std::array<Index, 3>> triangles{};
  int wires = 1;           ///< side by side in each segment
  double wire_radius = 0;  ///< m
};

class Builder {
 public:
  explicit Builder(const StructureScene& scene) : scene_(scene) {}

  Model build() {
    if (scene_.mesh_file) take_mesh_file();
    mesh_parts();
    if (scene_.weld) weld();
    for (const auto& [name, selection] : scene_.node_sets) {
      if (model_.node_sets.contains(name))
        throw core::ConfigError(fmt::format(
            "{}: structure.node_sets.{}: a part has this name, or gives it to nodes of its own; take another",
            selection.place, name));
      model_.node_sets[name] = select_nodes(model_, selection);
    }
    for (const auto& part : scene_.parts)
      if (const auto* through = std::get_if<ThroughScene>(&part.second.shape))
        lead_through(part.first, part.second, *through);
    put_sliders_on_ropes();
    for (auto& part : parts_) add_elements(part);
    for (const auto& slide : scene_.slides) add_slide(slide, model_);
    lump_masses(model_);
    add_conditions();
    check_masses();
    refuse_folding_chains(model_);
    warn_of_unheld_parts();
    warn_of_loose_ends();
    return std::move(model_);
  }

 private:
  void take_mesh_file();
  void mesh_parts();
  void add_group(const std::string& name, const PartScene& part, const std::string& group);
  void add_mesh(const std::string& name, const PartScene& part, const mesh::Net& net);
  void weld();
  void lead_through(const std::string& name, const PartScene& part, const ThroughScene& through);
  bool is_box(const std::string& set) const;
  Index add_node(const Vector3& position);
  Index end_of_rope(const Vector3& position);
  void put_sliders_on_ropes();
  void add_elements(MeshedPart& part);
  void add_conditions();
  void check_masses() const;
  void warn_of_unheld_parts() const;
  void warn_of_loose_ends() const;

  const StructureScene& scene_;
  Model model_;
  std::vector<MeshedPart> parts_;
  std::vector<Index> part_of_node_;
  std::map<std::string, mesh::GroupCells> groups_;  ///< that parts take of the structure's mesh file
  Index meshes_ = 0;                                ///< made so far
};

/// Its nodes count as those of one part where parts are welded: they are joined as the file numbers them.
void Builder::take_mesh_file() {
  std::vector<std::string> groups;
  for (const auto& [name, part] : scene_.parts)
    if (const auto* group = std::get_if<GroupScene>(&part.shape)) groups.push_back(group->name);
  MeshGroups mesh = take_groups(*scene_.mesh_file, groups);
  for (const auto& [name, part] : scene_.parts) {
    const auto* group = std::get_if<GroupScene>(&part.shape);
    if (mesh.node_sets.contains(name) && !(group && group->name == name))
      throw core::ConfigError(fmt::format(
          "{}: structure.parts.{}: {} has a group of this name, which is not what the part is made of; "
          "take another name",
          part.place, name, scene_.mesh_file->path.string()));
  }
  constexpr Index of_the_file = -1;
  model_.reference = std::move(mesh.positions);
  part_of_node_.assign(static_cast<std::size_t>(model_.nodes()), of_the_file);
  model_.node_sets = std::move(mesh.node_sets);
  groups_ = std::move(mesh.cells);
}

void Builder::mesh_parts() {
  for (const auto& [name, part] : scene_.parts) {
    std::visit(
        [&, &name = name, &part = part](const auto& shape) {
          using Shape = std::decay_t<decltype(shape)>;
          if constexpr (std::is_same_v<Shape, GroupScene>)
            add_group(name, part, shape.name);
          else if constexpr (std::is_same_v<Shape, mesh::RingNetScene>)
            add_mesh(name, part, is_made_of_rings(part) ? generate_polygons(shape) : generate(shape));
          else if constexpr (!std::is_same_v<Shape, ThroughScene>)
            add_mesh(name, part, generate(shape));
        },
        part.shape);
  }
}

void Builder::add_group(const std::string& name, const PartScene& part, const std::string& group) {
  const mesh::GroupCells& cells = groups_.at(group);
  parts_.push_back({.name = name,
                    .scene_name = name,
                    .scene = &part,
                    .segments = cells.segments,
                    .triangles = cells.triangles});
  std::vector<Index>& nodes = model_.node_sets[name];
  nodes.clear();  // a group of the same name lists the same nodes
  std::vector<bool> listed(static_cast<std::size_t>(model_.nodes()));
  const auto list = [&](const auto& elements) {
    for (const auto& element : elements)
      for (const Index node : element)
        if (!listed[static_cast<std::size_t>(node)]) {
          listed[static_cast<std::size_t>(node)] = true;
          nodes.push_back(node);
        }
  };
  list(cells.segments);
  list(cells.triangles);
}

/// Runs of a surface whose segments have the same number of wires: the first of them has no name, others that of the
/// pattern's part, such as `twist`.
std::vector<mesh::SurfacePart> runs_of_wires(const mesh::Surface& surface) {
  std::vector<mesh::SurfacePart> runs{{.segment_end = static_cast<Index>(surface.segments.size()),
                                       .triangle_end = static_cast<Index>(surface.triangles.size())}};
  if (!surface.parts.empty()) {
    runs.front().wires = surface.parts.front().wires;
    runs.front().wire_radius = surface.parts.front().wire_radius;
  }
  for (const auto& part : surface.parts) {
    if (part.wires == runs.back().wires) continue;
    runs.back().segment_end = part.segment_begin;
    runs.push_back(part);
    runs.back().segment_end = static_cast<Index>(surface.segments.size());
  }
  std::erase_if(runs, [](const mesh::SurfacePart& run) {
    return run.segment_begin == run.segment_end && run.triangle_begin == run.triangle_end;
  });
  return runs;
}

void Builder::add_mesh(const std::string& name, const PartScene& part, const mesh::Net& net) {
  if (!has_no_element(part))
    mesh::check(net.surface, part.place + ": structure.parts." + name,
                is_made_of_rings(part) ? mesh::Segments::directed : mesh::Segments::either_way);
  const Index first = model_.nodes();
  model_.reference.insert(model_.reference.end(), net.surface.positions.begin(), net.surface.positions.end());
  part_of_node_.resize(static_cast<std::size_t>(model_.nodes()), meshes_++);
  for (const mesh::SurfacePart& run : runs_of_wires(net.surface)) {
    MeshedPart& meshed =
        parts_.emplace_back(MeshedPart{.name = run.name.empty() ? name : name + "." + run.name,
                                       .scene_name = name,
                                       .scene = &part,
                                       .wires = run.wires,
                                       .wire_radius = run.wire_radius});
    for (Index s = run.segment_begin; s < run.segment_end; ++s) {
      const auto [a, b] = net.surface.segments[static_cast<std::size_t>(s)];
      meshed.segments.push_back({first + a, first + b});
    }
    for (Index t = run.triangle_begin; t < run.triangle_end; ++t) {
      const auto [a, b, c] = net.surface.triangles[static_cast<std::size_t>(t)];
      meshed.triangles.push_back({first + a, first + b, first + c});
    }
  }
  for (const auto& set : net.node_sets) {
    auto& nodes = model_.node_sets[set.name == "nodes" ? name : name + "." + set.name];
    for (const Index node : set.nodes) nodes.push_back(first + node);
  }
}

void Builder::weld() {
  const std::vector<Index> becomes = weld_map(model_.reference, part_of_node_, scene_.weld->tolerance);
  std::vector<Index> number(becomes.size());
  std::vector<double> positions;
  for (std::size_t i = 0; i < becomes.size(); ++i) {
    const auto target = static_cast<std::size_t>(becomes[i]);
    number[i] = target == i ? static_cast<Index>(positions.size() / 3) : number[target];
    if (target == i)
      positions.insert(positions.end(), &model_.reference[3 * i], &model_.reference[3 * i] + 3);
  }
  const auto renumber = [&](auto& nodes) {
    for (Index& node : nodes) node = number[static_cast<std::size_t>(node)];
  };
  for (auto& part : parts_) {
    for (auto& segment : part.segments) {
      renumber(segment);
      if (segment[0] == segment[1])
        throw core::ConfigError(
            fmt::format("structure.weld: the tolerance of {:.4g} m joins both ends of an element of {}",
                        scene_.weld->tolerance, part.name));
    }
    for (auto& triangle : part.triangles) renumber(triangle);
  }
  for (auto& [name, nodes] : model_.node_sets) renumber(nodes);
  model_.reference = std::move(positions);
}

Index Builder::add_node(const Vector3& position) {
  model_.reference.insert(model_.reference.end(), position.begin(), position.end());
  return model_.nodes() - 1;
}

/// A node of another part where the scene welds and there is one within its tolerance, or else a new one.
Index Builder::end_of_rope(const Vector3& position) {
  if (!scene_.weld) return add_node(position);
  Index nearest = -1;
  double least = scene_.weld->tolerance;
  for (Index node = 0; node < model_.nodes(); ++node)
    if (const double distance = (model_.position(node) - position).norm(); distance <= least) {
      least = distance;
      nearest = node;
    }
  return nearest >= 0 ? nearest : add_node(position);
}

void Builder::put_sliders_on_ropes() {
  for (const auto& slide : scene_.slides) {
    const auto rope = std::ranges::find(parts_, slide.second.rope, &MeshedPart::name);
    if (rope != parts_.end()) put_on_rope(slide, rope->segments, model_);  // else add_slide() refuses it
  }
}

/// Whether a box selected the set's nodes, which have no order along a rope then.
bool Builder::is_box(const std::string& set) const {
  const auto found = std::ranges::find(scene_.node_sets, set, [](const auto& entry) { return entry.first; });
  return found != scene_.node_sets.end() && found->second.box.has_value();
}

void Builder::lead_through(const std::string& name, const PartScene& part, const ThroughScene& through) {
  std::vector<RopeStretch> stretches;
  if (through.from) stretches.push_back({{end_of_rope(*through.from)}});
  for (const auto& set : through.nodes) {
    const auto& nodes = find_node_set(model_, part.place, set);
    stretches.push_back({{nodes.begin(), nodes.end()}, !is_box(set)});
  }
  if (through.to) stretches.push_back({{end_of_rope(*through.to)}});
  put_in_order(stretches, model_);
  std::vector<Index> nodes;
  for (const RopeStretch& stretch : stretches)
    for (const Index node : stretch.nodes)
      if (nodes.empty() || nodes.back() != node) nodes.push_back(node);
  const double way = way_along(nodes, model_), shortest = way_to_nearest(nodes, model_);
  if (constexpr double to_and_fro = 2; way > to_and_fro * shortest)
    core::log_warning(
        fmt::format("{}: structure.parts.{}: the rope is {:.4g} m long, and {:.4g} m from each node to the "
                    "nearest one left: it "
                    "runs to and fro, as its sets list their nodes",
                    part.place, name, way, shortest));
  else if (const Index node = first_turn_back(nodes, model_); node >= 0)
    core::log_warning(fmt::format(
        "{}: structure.parts.{}: the rope turns back at {}: are its sets in their order along it?",
        part.place, name, node_name(model_, node)));
  MeshedPart& meshed = parts_.emplace_back(MeshedPart{.name = name, .scene_name = name, .scene = &part});
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    if ((model_.position(nodes[i]) - model_.position(nodes[i + 1])).isZero(0))
      throw core::ConfigError(
          fmt::format("{}: structure.parts.{}: the rope passes twice through the same point, at {}",
                      part.place, name, node_name(model_, nodes[i])));
    meshed.segments.push_back({nodes[i], nodes[i + 1]});
  }
  if (meshed.segments.empty())
    throw core::ConfigError(
        fmt::format("{}: structure.parts.{}: a rope needs at least two nodes", part.place, name));
  model_.node_sets[name] = nodes;
  model_.node_sets[name + ".start"] = {nodes.front()};
  model_.node_sets[name + ".end"] = {nodes.back()};
}

void Builder::add_elements(MeshedPart& part) {
  std::vector<Index> nodes;
  for (const auto& segment : part.segments) nodes.insert(nodes.end(), segment.begin(), segment.end());
  for (const auto& triangle : part.triangles) nodes.insert(nodes.end(), triangle.begin(), triangle.end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const MeshedElements elements{fmt::format("{}: structure.parts.{}", part.scene->place, part.name),
                                std::move(part.segments), std::move(part.triangles)};
  const ElementScene element = of_wires(part.scene->element, part.wires);
  model_.parts.push_back({part.name, make_elements(element, elements, model_), std::move(nodes)});
  Part& made = model_.parts.back();
  made.breaking_load = breaking_load_of(element);
  made.buckling_load = buckling_load_of(element, made.elements);
  made.scene_part = part.scene_name;
  made.wire_radius = part.wire_radius;
}

std::string label(const char* kind, std::size_t number, const NodeSelection& where) {
  return where.nodes ? fmt::format("{}", *where.nodes) : fmt::format("{}{}", kind, number);
}

void Builder::add_conditions() {
  for (const auto& s : scene_.supports) {
    Support support{.name = label("support", model_.supports.size(), s.where),
                    .nodes = select_nodes(model_, s.where),
                    .fixed = {s.fix.find('x') != std::string::npos, s.fix.find('y') != std::string::npos,
                              s.fix.find('z') != std::string::npos},
                    .displacement = s.displacement.value_or(Vector3::Zero()),
                    .history = {s.over_time}};
    if (s.velocity) {  // so many metres after so many seconds
      constexpr double long_after = 1e9;
      support.displacement = *s.velocity;
      support.history = {{{0, 0}, {long_after, long_after}}};
    }
    model_.supports.push_back(std::move(support));
  }
  for (const auto& l : scene_.loads)
    model_.loads.push_back(
        {label("load", model_.loads.size(), l.where), select_nodes(model_, l.where), l.force, {l.over_time}});
  std::vector<double> point_masses(model_.node_masses.size(), 0.0);
  for (const auto& mass : scene_.point_masses)
    for (const Index node : select_nodes(model_, mass.where)) {
      model_.node_masses[static_cast<std::size_t>(node)] += mass.mass;
      point_masses[static_cast<std::size_t>(node)] += mass.mass;
    }
  for (const auto& initial : scene_.initial_displacements)
    model_.initial_displacements.push_back({select_nodes(model_, initial.where), initial.displacement});
  for (const auto& initial : scene_.initial_velocities)
    model_.initial_velocities.push_back({select_nodes(model_, initial.where), initial.velocity});
  for (const auto& obstacle : scene_.obstacles) add_obstacle(obstacle, model_);
  held_directions(model_);  // which refuses supports that contradict each other
  model_.gravity_history = {scene_.gravity_over_time};
  weigh_and_damp(scene_, point_masses, model_);
  let_held_bars_turn(model_);
}

void Builder::check_masses() const {
  const auto found = std::ranges::find(model_.node_masses, 0.0);
  if (found == model_.node_masses.end()) return;
  const auto node = static_cast<Index>(found - model_.node_masses.begin());
  throw core::ConfigError("structure: no element is connected to " + node_name(model_, node));
}

void Builder::warn_of_unheld_parts() const {
  for (const auto& parts : unheld_parts(model_))
    core::log_warning(
        fmt::format("structure: nothing holds {}: it falls or floats freely", fmt::join(parts, ", ")));
}

void Builder::warn_of_loose_ends() const {
  constexpr std::size_t most = 5;
  const auto ends = loose_ends(model_);
  for (std::size_t k = 0; k < std::min(most, ends.size()); ++k)
    core::log_warning(fmt::format(
        "structure: {}{}", ends[k],
        scene_.weld ? fmt::format(": weld.tolerance is {}", core::readable(scene_.weld->tolerance, "m"))
                    : std::string(": `weld` joins parts where their nodes coincide")));
  if (ends.size() > most)
    core::log_warning(fmt::format("structure: {} more ends of lines hang beside a node", ends.size() - most));
}

}  // namespace

Model build_model(const StructureScene& scene) {
  return Builder(scene).build();
}

}  // namespace talus::fem
