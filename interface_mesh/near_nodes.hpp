#pragma once

#include <string>
#include <vector>

#include "interface_mesh/net.hpp"

/// Nodes that a file may have meant to be one: a surface is torn there.
namespace talus::mesh {

/// @pre first < second
struct NearNodes {
  Index first = 0, second = 0;
  double distance = 0;  ///< m
};

/// Pairs of loose nodes (on edges of one triangle only, or at the end of one line) that are nearer to each
/// other than a thousandth of the shortest edge at either. Any two of a mesh that is meant so are further
/// apart; what rounding to seven digits tears is nearer.
std::vector<NearNodes> nearly_joined(const Surface& surface);

/// Joins loose nodes that are not further apart than the tolerance, each with the first of them; where
/// several are in reach of each other in a row, all become one. Nodes inside of a surface stay what they are.
/// @param tolerance m; 0 joins those at the same place
/// @throws core::ConfigError headed by `what` if that would join two corners of one cell
Net join_loose_nodes(const Net& net, double tolerance, const std::string& what);

/// @throws core::ConfigError headed by `what` that names the nodes which are nearly joined, their distance,
/// and the `join` that joins them
void refuse_nearly_joined(const Surface& surface, const std::string& what);

}  // namespace talus::mesh
