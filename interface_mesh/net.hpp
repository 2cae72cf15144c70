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

/// What a generator makes. Every net has the sets `nodes` (all) and `rim` (on the outline, counter-clockwise
/// seen against along x across, from the corner); rectangular ones also `corners`, `edge_south`, `edge_east`,
/// `edge_north`, `edge_west`, each with both its corners and in the rim's direction; south runs along the
/// first axis.
struct Net {
  Surface surface;
  std::vector<NodeSet> node_sets;

  /// nullptr where there is no such set.
  const NodeSet* find_set(const std::string& name) const;
};

}  // namespace talus::mesh
