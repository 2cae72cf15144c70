#include "fem_solver/scene/obstacles.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.hpp"
#include "core/scene/plausible.hpp"
#include "core/units/units.hpp"
#include "fem_solver/constraints/held_directions.hpp"
#include "fem_solver/scene/node_sets.hpp"

namespace talus::fem {
namespace {

std::string key(const NamedObstacle& obstacle) {
  return fmt::format("{}: structure.obstacles.{}", obstacle.second.place, obstacle.first);
}

/// Of its sets, ascending, without those that supports hold.
std::vector<Index> nodes_of(const NamedObstacle& obstacle, const Model& model) {
  std::vector<Index> nodes;
  for (const auto& set : obstacle.second.nodes) {
    const auto& found = find_node_set(model, key(obstacle) + ".nodes", set);
    nodes.insert(nodes.end(), found.begin(), found.end());
  }
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const std::vector<bool> held = held_nodes(model);
  std::erase_if(nodes, [&](Index node) { return held[static_cast<std::size_t>(node)]; });
  if (nodes.empty())
    throw core::ConfigError(key(obstacle) + ".nodes: supports hold all of them, so there is nothing to stop");
  return nodes;
}

/// N/m: soft beside what already holds the node, so that the step limit hardly feels it.
std::vector<double> stiffness_of(const NamedObstacle& obstacle, const std::vector<Index>& nodes,
                                 const Model& model) {
  if (obstacle.second.stiffness) return std::vector<double>(nodes.size(), *obstacle.second.stiffness);
  constexpr double share = 0.1;
  const std::vector<double> rest(model.reference.size(), 0.0), sums = stiffness_bounds(model, rest);
  std::vector<double> stiffness;
  for (const Index node : nodes) {
    const double* own = &sums[3 * static_cast<std::size_t>(node)];
    stiffness.push_back(share * std::max({own[0], own[1], own[2]}));
  }
  return stiffness;
}

}  // namespace

void describe(core::Fields& fields, ObstaclePlaneScene& plane) {
  fields.required("point", plane.point, {.unit = "m", .help = "any point of the plane"});
  fields.required("normal", plane.normal, {.help = "to the side where nodes may be; any length"});
  fields.rule(plane.normal.norm() > 0, "normal", "must not be zero");
}

void describe(core::Fields& fields, ObstacleScene& obstacle) {
  obstacle.place = fields.place();
  fields.section("plane", obstacle.plane, "the obstacle is a fixed plane");
  fields.rule(obstacle.plane.has_value(), "", "needs `plane`: the only shape of an obstacle so far");
  fields.required("nodes", obstacle.nodes, {.help = "node sets that it stops: [net, upper_rope]"});
  fields.with_default("distance", obstacle.distance,
                      {.unit = "m",
                       .range = core::not_negative,
                       .help = "that nodes keep from it, such as the radius of a rope"});
  fields.with_default(
      "friction", obstacle.friction,
      {.range = core::not_negative, .help = "Coulomb's coefficient", .plausible = core::plausible::friction});
  fields.optional("stiffness", obstacle.stiffness,
                  {.unit = "N/m",
                   .range = core::positive,
                   .help = "against each node; a tenth of what holds the node itself where absent",
                   .plausible = core::plausible::stiffness});
}

void add_obstacle(const NamedObstacle& obstacle, Model& model) {
  const auto& [name, scene] = obstacle;
  if (std::ranges::find(model.parts, name, &Part::name) != model.parts.end())
    throw core::ConfigError(fmt::format("{}: there is a part of this name already", key(obstacle)));
  const std::vector<Index> nodes = nodes_of(obstacle, model);
  const PlaneContact plane{.point = scene.plane->point,
                           .normal = scene.plane->normal.normalized(),
                           .distance = scene.distance,
                           .friction = scene.friction,
                           .stiffness = 0};
  constexpr double touching = 1e-9;  // m; written on the plane
  const Index deepest =
      *std::ranges::max_element(nodes, {}, [&](Index node) { return plane.depth(model.position(node)); });
  if (const double depth = plane.depth(model.position(deepest)); depth > touching)
    throw core::ConfigError(fmt::format("{}: {} is {} behind it at the start; move it, or the plane",
                                        key(obstacle), node_name(model, deepest),
                                        core::readable(depth, "m")));
  model.parts.push_back(
      {name, ObstacleBatch(plane, nodes, stiffness_of(obstacle, nodes, model), model.reference), nodes});
}

}  // namespace talus::fem
