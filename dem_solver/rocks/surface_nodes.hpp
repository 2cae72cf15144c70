#pragma once

#include "core/vector3.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::dem {

/// m; the place of a node.
inline core::Vector3 node(const mesh::Surface& surface, mesh::Index i) {
  return core::Vector3(&surface.positions[3 * static_cast<std::size_t>(i)]);
}

}  // namespace talus::dem
