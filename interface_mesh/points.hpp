#pragma once

#include <span>

#include "core/vector3.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::mesh {

/// Node `node` of a flat array of points, x y z of each in turn.
inline core::Vector3 point(std::span<const double> positions, Index node) {
  const auto at = 3 * static_cast<std::size_t>(node);
  return {positions[at], positions[at + 1], positions[at + 2]};
}

inline void append(std::vector<double>& positions, const core::Vector3& point) {
  positions.insert(positions.end(), {point.x(), point.y(), point.z()});
}

/// "(1.5, 1.5, 0) m", as errors name places.
std::string describe_point(const core::Vector3& point);

}  // namespace talus::mesh
