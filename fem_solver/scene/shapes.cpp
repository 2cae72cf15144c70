#include "fem_solver/scene/shapes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/errors.hpp"
#include "interface_mesh/square_net.hpp"

namespace talus::fem {
namespace {

using mesh::Index;

void append(mesh::Surface& surface, const core::Vector3& point) {
  surface.positions.insert(surface.positions.end(), {point.x(), point.y(), point.z()});
}

mesh::NodeSet all_nodes(const mesh::Surface& surface) {
  mesh::NodeSet set{"nodes", {}};
  for (Index i = 0; i < surface.node_count(); ++i) set.nodes.push_back(i);
  return set;
}

Index node_number(double written, const mesh::Surface& surface) {
  if (written != std::floor(written) || written < 0 || written >= surface.node_count())
    throw core::ConfigError(fmt::format("an element names node {}, but the nodes are numbered 0 to {}",
                                        written, surface.node_count() - 1));
  return static_cast<Index>(written);
}

/// Nodes that can be named by their numbers.
mesh::Net numbered_nodes(const std::vector<core::Vector3>& places) {
  mesh::Net net;
  for (const auto& node : places) append(net.surface, node);
  net.node_sets = {all_nodes(net.surface)};
  for (Index i = 0; i < net.surface.node_count(); ++i) net.node_sets.push_back({std::to_string(i), {i}});
  return net;
}

}  // namespace

void describe(core::Fields& fields, PolylineScene& polyline) {
  fields.required("points", polyline.points, {.unit = "m", .help = "corners of the line, at least two"});
  fields.with_default("divisions", polyline.divisions,
                      {.range = {.low = 1, .high = 1e7}, .help = "elements between two neighbouring points"});
  fields.rule(polyline.points.size() >= 2, "points", "needs at least two points");
}

void describe(core::Fields& fields, MeshScene& mesh) {
  fields.required("nodes", mesh.nodes, {.unit = "m", .help = "positions of the nodes, numbered from 0"});
  fields.with_default("segments", mesh.segments,
                      {.range = core::not_negative, .help = "pairs of node numbers"});
  fields.with_default("triangles", mesh.triangles,
                      {.range = core::not_negative, .help = "triples of node numbers, counter-clockwise"});
  fields.rule(mesh.segments.empty() != mesh.triangles.empty(), "segments",
              "needs either `segments` or `triangles`");
}

void describe(core::Fields& fields, NodesScene& nodes) {
  fields.required("at", nodes.at, {.unit = "m", .help = "positions of the nodes, numbered from 0"});
  fields.rule(!nodes.at.empty(), "at", "needs at least one node");
}

void describe(core::Fields& fields, ThroughScene& through) {
  fields.required("nodes", through.nodes,
                  {.help = "node sets the rope runs through, in this order: [net.edge_south]"});
  fields.optional("from", through.from, {.unit = "m", .help = "an own end before the first of these nodes"});
  fields.optional("to", through.to, {.unit = "m", .help = "an own end after the last of these nodes"});
}

void describe(core::Fields& fields, GroupScene& group) {
  fields.required("name", group.name, {.help = "of a physical group of `structure.mesh_file`"});
}

void describe_shape(core::Fields& fields, ShapeScene& shape) {
  fields.one_of(shape,
                mesh::net_alternatives(
                    {{"sheet", "a panel filled with triangles"},
                     {"mesh_file", "a mesh made elsewhere"},
                     {"polyline", "a rope or bar along straight lines"},
                     {"mesh", "nodes and elements written out"},
                     {"nodes", "nodes alone, without an element: ropes run through them"},
                     {"through", "a rope through nodes of other parts"},
                     {"group", "a group of the structure's mesh file, whose groups share their nodes"}}));
}

mesh::Net generate(const PolylineScene& polyline) {
  mesh::Net net;
  mesh::NodeSet corners{"points", {0}};
  append(net.surface, polyline.points.front());
  for (std::size_t i = 0; i + 1 < polyline.points.size(); ++i) {
    const core::Vector3 &a = polyline.points[i], &b = polyline.points[i + 1];
    for (std::int64_t k = 1; k <= polyline.divisions; ++k) {
      const Index last = net.surface.node_count();
      append(net.surface, k == polyline.divisions ? b
                                                  : a + (b - a) * static_cast<double>(k) /
                                                            static_cast<double>(polyline.divisions));
      net.surface.segments.push_back({last - 1, last});
    }
    corners.nodes.push_back(net.surface.node_count() - 1);
  }
  net.node_sets = {all_nodes(net.surface), {"start", {0}}, {"end", {net.surface.node_count() - 1}}, corners};
  return net;
}

mesh::Net generate(const NodesScene& scene) {
  return numbered_nodes(scene.at);
}

mesh::Net generate(const MeshScene& scene) {
  mesh::Net net = numbered_nodes(scene.nodes);
  for (const auto& [a, b] : scene.segments)
    net.surface.segments.push_back({node_number(a, net.surface), node_number(b, net.surface)});
  for (const auto& t : scene.triangles)
    net.surface.triangles.push_back(
        {node_number(t.x(), net.surface), node_number(t.y(), net.surface), node_number(t.z(), net.surface)});
  return net;
}

}  // namespace talus::fem
