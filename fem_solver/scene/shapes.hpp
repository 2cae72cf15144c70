#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/scene/fields.hpp"
#include "interface_mesh/net.hpp"
#include "interface_mesh/scene/mesh_file.hpp"
#include "interface_mesh/scene/nets.hpp"
#include "interface_mesh/scene/sheet.hpp"

/// Where the nodes and elements of a part come from.
namespace talus::fem {

/// `polyline:` a rope or bar along straight lines. Node sets: nodes, start, end, points.
struct PolylineScene {
  std::vector<core::Vector3> points;  ///< m
  std::int64_t divisions = 1;         ///< elements between two points
};
void describe(core::Fields& fields, PolylineScene& polyline);

/// `mesh:` nodes and elements written out. Node sets: nodes, and one a node named by its number.
struct MeshScene {
  std::vector<core::Vector3> nodes;                 ///< m
  std::vector<std::pair<double, double>> segments;  ///< numbers of nodes, from 0
  std::vector<core::Vector3> triangles;             ///< numbers of nodes, from 0
};
void describe(core::Fields& fields, MeshScene& mesh);

/// `nodes:` nothing but nodes, for ropes that run through them. Node sets: nodes, and one a node named by its number.
struct NodesScene {
  std::vector<core::Vector3> at;  ///< m
};
void describe(core::Fields& fields, NodesScene& nodes);

/// `through:` a rope through nodes of other parts, in the order of their sets. Node sets: nodes, start, end.
struct ThroughScene {
  std::vector<std::string> nodes;     ///< node sets
  std::optional<core::Vector3> from;  ///< m; an own node before the first
  std::optional<core::Vector3> to;    ///< m; an own node after the last
};
void describe(core::Fields& fields, ThroughScene& through);

/// `group:` elements of the structure's own mesh file, with the nodes that its groups share. Node sets: nodes; and the
/// structure's, one for each group of the file.
struct GroupScene {
  std::string name;
};
void describe(core::Fields& fields, GroupScene& group);

using ShapeScene = mesh::NetChoice<mesh::SheetScene, mesh::MeshFileScene, PolylineScene, MeshScene,
                                   NodesScene, ThroughScene, GroupScene>;
void describe_shape(core::Fields& fields, ShapeScene& shape);

mesh::Net generate(const PolylineScene& polyline);
/// @throws core::ConfigError where an element names a node that is not there
mesh::Net generate(const MeshScene& mesh);

mesh::Net generate(const NodesScene& nodes);

}  // namespace talus::fem
