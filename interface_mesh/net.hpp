#pragma once

#include <string>
#include <vector>

#include "interface_mesh/surface.hpp"

namespace talus::mesh {

/// Nodes that a scene can name, e.g. to fix them or to lead a rope through them.
struct NodeSet {
  std::string name;
  std::vector<Index> nodes;
  bool operator==(const NodeSet&) const = default;
};

/// Cells of a surface that a file lists as a group. Groups may overlap, which parts of a surface may not.
struct CellSet {
  std::string name;
  std::vector<Index> segments{}, triangles{};
  std::vector<Index> turned{};  ///< those of the triangles that the group lists the other way round
  bool operator==(const CellSet&) const = default;
};

/// What a generator makes, or a file holds. Every net has the set `nodes` (all); generated ones also `rim`
/// (on the outline, counter-clockwise seen against along x across, from the corner); rectangular ones also
/// `corners`, `edge_south`, `edge_east`, `edge_north`, `edge_west`, each with both its corners and in the
/// rim's direction; south runs along the first axis.
struct Net {
  Surface surface;
  std::vector<NodeSet> node_sets;
  std::vector<CellSet> cell_sets{};  ///< of a file: its groups, objects, materials or solids

  /// nullptr where there is no such set.
  const NodeSet* find_set(const std::string& name) const;
};

}  // namespace talus::mesh
