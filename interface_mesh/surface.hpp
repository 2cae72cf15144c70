#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// Surfaces of nodes with segments and triangles: Ω_D, Ω_S, terrain, rock hulls.
namespace talus::mesh {

using Index = std::int32_t;

/// A run of segments and triangles that share contact properties, in file order.
struct SurfacePart {
  std::string name{};
  std::string material{};  ///< contact material of the particle side; empty: the scene's only one
  double wire_radius = 0;  ///< m; of its segments

  Index segment_begin = 0, segment_end = 0;
  Index triangle_begin = 0, triangle_end = 0;
  int wires = 1;  ///< side by side in each segment: 2 in a double twist
  bool operator==(const SurfacePart&) const = default;
};

/// Node positions at the reference state and what spans between them. Plain data: a surface is sent between
/// processes as its arrays.
struct Surface {
  std::vector<double> positions{};  ///< m; 3 a node
  std::vector<std::array<Index, 2>> segments{};
  std::vector<std::array<Index, 3>> triangles{};  ///< counter-clockwise seen from outside
  std::vector<SurfacePart> parts{};
  std::vector<double> start{};  ///< m; displacement of each node at time 0, 3 a node; empty: none

  Index node_count() const { return static_cast<Index>(positions.size() / 3); }
  std::size_t cell_count() const { return segments.size() + triangles.size(); }
  bool operator==(const Surface&) const = default;
};

}  // namespace talus::mesh
