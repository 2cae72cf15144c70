#pragma once

#include <map>
#include <string>
#include <vector>

#include "fem_solver/model/index.hpp"
#include "interface_mesh/files/mesh_file.hpp"
#include "interface_mesh/scene/mesh_file.hpp"

namespace talus::fem {

/// What the parts of a structure take of one mesh file.
struct MeshGroups {
  std::vector<double> positions;  ///< m; 3 a node, of the nodes that its parts use, in the file's order
  std::map<std::string, mesh::GroupCells> cells;  ///< of each group taken, by these nodes
  std::map<std::string, std::vector<Index>>
      node_sets;  ///< of every group of the file that has some of these nodes
};

/// Warns of groups whose elements nobody takes.
/// @throws core::ConfigError as mesh::generate, and naming the groups there are where one is not among them
MeshGroups take_groups(const mesh::MeshFileScene& file, const std::vector<std::string>& groups);

}  // namespace talus::fem
