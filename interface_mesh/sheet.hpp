#pragma once

#include <array>
#include <vector>

#include "interface_mesh/panel.hpp"

namespace talus::mesh {

/// A panel filled with triangles: the homogenised net of the structure.
struct Sheet {
  Panel panel;
  double element_size = 0;  ///< m; wanted edge length of the triangles
  double edge_spacing = 0;  ///< m; wanted distance of the nodes on the outline; 0: the element size
  std::vector<Vector2>
      edge_nodes{};  ///< m; where on the outline nodes must be, e.g. those of a rope's shackles
  std::array<Index, 2> crossed_cells{};  ///< of a rectangle, along and across, each cut by both its
                                         ///< diagonals; absent: the element size decides
};

/// One part, `sheet`; triangles counter-clockwise about along x across. A rectangle whose edges are left to
/// the element size is divided in rows, its openings halved by diagonals of alternating direction, so that
/// the sheet has no preferred one. `crossed_cells` instead lays edges of triangles along two directions: the
/// wires of a chain-link net, which a mesh must follow to shear as freely as they do. Any other panel gets
/// nodes evenly spaced between its corners and the prescribed ones, and a Delaunay triangulation inside.
/// Nodes of the outline come first and run counter-clockwise from the first corner in the latter case.
/// @pre element_size > 0 or crossed_cells, those only with a rectangle and alone; the prescribed nodes lie on
/// the outline, no two at one place
Net generate(const Sheet& sheet);

}  // namespace talus::mesh
