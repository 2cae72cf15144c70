#pragma once

#include <array>

#include "core/vector3.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::dem {

/// A triangle of a surface with the places of its corners.
struct Face {
  std::array<mesh::Index, 3> nodes;
  std::array<core::Vector3, 3> corners;  ///< m
  bool has(mesh::Index node) const;
};
Face face(const mesh::Surface& surface, std::int32_t triangle);

/// Whether an edge of one passes through the inside of the other. Those that touch, or might do no more than
/// that within round-off, do not cross.
bool cross_each_other(const Face& f, const Face& g);

}  // namespace talus::dem
