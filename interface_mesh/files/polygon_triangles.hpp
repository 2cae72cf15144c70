#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/vector3.hpp"

namespace talus::mesh {

/// A face of any number of corners as triangles of the same turn, by the numbers of its corners. Corners that
/// follow each other at the same place count once. A face of four corners is cut between its first and third
/// where that leaves both triangles inside; more are triangulated in the plane across their area vector.
struct CutPolygon {
  std::vector<std::array<std::size_t, 3>> triangles;
  std::string fault;  ///< why the face has no triangles; empty for a sound one
};
/// Three corners are one triangle, whatever their places are.
CutPolygon cut_polygon(const std::vector<core::Vector3>& corners);

}  // namespace talus::mesh
