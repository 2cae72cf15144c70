#include "interface_mesh/square_net.hpp"

#include <algorithm>
#include <numeric>

#include "interface_mesh/points.hpp"

namespace talus::mesh {

namespace {

/// Node numbers of a grid of rows.
struct Grid {
  std::array<Index, 2> openings;
  Index node(Index column, Index row) const { return row * (openings[0] + 1) + column; }
};

void add_nodes(const SquareNet& net, Surface& surface) {
  const core::Vector3 south = net.along.normalized() * net.lengths[0];
  const core::Vector3 west = net.across.normalized() * net.lengths[1];
  for (Index row = 0; row <= net.openings[1]; ++row)
    for (Index column = 0; column <= net.openings[0]; ++column)
      append(surface.positions, net.corner + south * (double(column) / net.openings[0]) +
                                    west * (double(row) / net.openings[1]));
}

void add_segments(const Grid& grid, Surface& surface) {
  for (Index row = 0; row <= grid.openings[1]; ++row)
    for (Index column = 0; column < grid.openings[0]; ++column)
      surface.segments.push_back({grid.node(column, row), grid.node(column + 1, row)});
  for (Index column = 0; column <= grid.openings[0]; ++column)
    for (Index row = 0; row < grid.openings[1]; ++row)
      surface.segments.push_back({grid.node(column, row), grid.node(column, row + 1)});
}

/// The four edges in the rim's direction, both corners in each.
std::vector<NodeSet> edges(const Grid& grid) {
  const auto [columns, rows] = grid.openings;
  std::vector<NodeSet> sets{{"edge_south", {}}, {"edge_east", {}}, {"edge_north", {}}, {"edge_west", {}}};
  for (Index i = 0; i <= columns; ++i) {
    sets[0].nodes.push_back(grid.node(i, 0));
    sets[2].nodes.push_back(grid.node(columns - i, rows));
  }
  for (Index j = 0; j <= rows; ++j) {
    sets[1].nodes.push_back(grid.node(columns, j));
    sets[3].nodes.push_back(grid.node(0, rows - j));
  }
  return sets;
}

std::vector<NodeSet> node_sets(const Grid& grid, Index node_count) {
  NodeSet all{"nodes", std::vector<Index>(static_cast<std::size_t>(node_count))}, rim{"rim", {}},
      corners{"corners", {}};
  std::iota(all.nodes.begin(), all.nodes.end(), Index{0});
  auto sets = edges(grid);
  for (const auto& edge : sets) {
    rim.nodes.insert(rim.nodes.end(), edge.nodes.begin(), edge.nodes.end() - 1);
    corners.nodes.push_back(edge.nodes.front());
  }
  sets.insert(sets.begin(), {all, rim, corners});
  return sets;
}

}  // namespace

const NodeSet* Net::find_set(const std::string& name) const {
  const auto found =
      std::find_if(node_sets.begin(), node_sets.end(), [&](const NodeSet& set) { return set.name == name; });
  return found == node_sets.end() ? nullptr : &*found;
}

Net generate(const SquareNet& net) {
  const Grid grid{net.openings};
  Net result;
  Surface& surface = result.surface;
  add_nodes(net, surface);
  add_segments(grid, surface);
  SurfacePart wire{.name = "wire", .wire_radius = net.wire_diameter / 2};
  wire.segment_end = static_cast<Index>(surface.segments.size());
  surface.parts.push_back(std::move(wire));
  result.node_sets = node_sets(grid, surface.node_count());
  return result;
}

}  // namespace talus::mesh
