#pragma once

#include "dem_solver/rocks/mass_properties.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::dem {

/// Volume moments of a closed surface of triangles, exact: the sum over the tetrahedra from the origin to
/// each triangle,
///     V = det/6   S = V (a + b + c)/4   C = V/20 (a a^T + b b^T + c c^T + s s^T), s = a + b + c
/// Test: "A block's mass properties are those of the closed form".
/// @pre the surface is closed (closed_surface.hpp)
VolumeMoments polyhedron_moments(const mesh::Surface& surface);

/// A cube without its corners, in the style of the test blocks of EAD 340059 (formerly ETAG 027): each corner
/// is cut at a fraction of the edge. Its volume is edge^3 (1 - 4/3 cut^3).
struct BlockShape {
  double edge = 0;  ///< m; of the full cube
  double cut = 0;   ///< of the edge, in (0, 1/2)
};
/// Centred at the origin, edges along the axes; facing outwards.
mesh::Surface make_block(const BlockShape& shape);
/// m; the edge that gives a mass. @param volume m^3
double block_edge(double volume, double cut);

}  // namespace talus::dem
