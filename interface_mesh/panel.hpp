#pragma once

#include <string>
#include <vector>

#include "core/vector3.hpp"
#include "interface_mesh/net.hpp"
#include "interface_mesh/polygon.hpp"

namespace talus::mesh {

/// A flat panel in space: the outline that nets are clipped to and sheets fill.
struct Panel {
  core::Vector3 origin = core::Vector3::Zero();   ///< m
  core::Vector3 along = core::Vector3::UnitX();   ///< unit vector
  core::Vector3 across = core::Vector3::UnitY();  ///< unit vector, perpendicular to `along`
  Polygon outline{};                      ///< m along and across from the origin; simple, counter-clockwise
  std::vector<std::string> edge_names{};  ///< of the node set on each edge of the outline

  core::Vector3 place(const Vector2& point) const { return origin + point.x() * along + point.y() * across; }
};

/// The edges of a rectangle are `edge_south`, `edge_east`, `edge_north`, `edge_west`; south runs from the
/// origin along `along`.
struct Rectangle {
  core::Vector3 corner, along,
      across;                    ///< directions of any length, not parallel; `across` is made perpendicular
  double length = 0, width = 0;  ///< m; of the south and of the west edge
};
Panel make_panel(const Rectangle& rectangle);

/// A panel from the corners of its outline in space (m), in either sense of rotation as seen from the side
/// the panel's normal is to point to: the edges are `edge_1`, `edge_2`, ..., edge 1 from the first corner to
/// the second, which is the direction `along`.
/// @pre flatness(corners) is small against their extent and find_fault() finds nothing in the plane
Panel make_panel(const std::vector<core::Vector3>& corners);

/// The largest distance of a corner from the plane fitted through all of them (m).
double flatness(const std::vector<core::Vector3>& corners);

/// Nodes that lie on a panel's outline, for the node sets.
struct RimNode {
  Index node = 0;
  std::size_t edge = 0;
  double share = 0;  ///< of the edge's length
};

/// The sets `nodes`, `rim`, `corners` and one an edge, as net.hpp describes them.
std::vector<NodeSet> rim_sets(const Panel& panel, std::vector<RimNode> rim, Index node_count);

}  // namespace talus::mesh
