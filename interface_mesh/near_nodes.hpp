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

/// Pairs of nodes that are nearer to each other than a thousandth of the shortest edge at either. Any two of a mesh
/// that is meant so are further apart; what rounding to seven digits tears is nearer.
std::vector<NearNodes> nearly_joined(const Surface& surface);

/// A node within an edge that is not its own.
struct NodeOnEdge {
  Index node = 0;
  std::array<Index, 2> edge{};
};

/// Nodes of open rims and of lines that lie within edges of open rims or lines: nearer than a thousandth of that edge
/// and of the shortest one at the node, and further from its ends. By node.
std::vector<NodeOnEdge> nodes_on_edges(const Surface& surface);

/// Joins nodes that are not further apart than the tolerance, each with the first of them; where several are in reach
/// of each other in a row, all become one.
/// @param tolerance m; 0 joins those at the same place
/// @throws core::ConfigError headed by `what` if that would join two corners of one cell
Net join_near_nodes(const Net& net, double tolerance, const std::string& what);

/// @throws core::ConfigError headed by `what` that names nodes which are nearly joined, their distance, and the `join`
/// that joins them; or nodes that lie within edges
void refuse_torn(const Surface& surface, const std::string& what);

}  // namespace talus::mesh
