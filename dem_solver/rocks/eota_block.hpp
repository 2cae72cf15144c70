#pragma once

#include "interface_mesh/surface.hpp"

namespace talus::dem {

/// The test blocks of EAD 340059-00-0106 (rock fall protection kits): a cube of edge L with edges and corners cut, whose 24
/// corners are the permutations of (+-1, +-1/2, +-1/2) L/2: 6 squares, 12 rectangles and 8 triangles. Its volume is 17/24
/// L^3. The flat one is half as high along z.
struct EotaBlock {
  double edge = 0;    ///< m; L
  bool flat = false;  ///< 2 : 2 : 1 in place of 1 : 1 : 1
};
/// Centred at the origin, faces outwards. Test: "The test blocks have 26 faces, ...".
mesh::Surface make_eota_block(const EotaBlock& block);
/// m; L of a volume (m^3).
double eota_edge(double volume, bool flat);

}  // namespace talus::dem
