#pragma once

#include "interface_mesh/surface.hpp"

namespace talus::mesh {

/// Every segment as an open prism of triangles around it, its corners on the circle of the wire radius: for
/// contact programs and pictures that know no wires. Parts and materials are kept, in their order.
/// @pre sides >= 3; wire radii > 0
Surface as_tubes(const Surface& wires, Index sides);

}  // namespace talus::mesh
