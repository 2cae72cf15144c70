#include "dem_solver/rocks/eota_block.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "dem_solver/rocks/surface_nodes.hpp"

namespace talus::dem {

namespace {

/// Every point of a body that is the same whichever way a coordinate is turned round.
std::vector<core::Vector3> corners_of(double edge) {
  std::vector<core::Vector3> corners;
  for (int axis = 0; axis < 3; ++axis)
    for (int signs = 0; signs < 8; ++signs) {
      core::Vector3 p = core::Vector3::Constant(0.25 * edge);
      p[axis] = 0.5 * edge;
      for (int k = 0; k < 3; ++k)
        if (signs & (1 << k)) p[k] = -p[k];
      corners.push_back(p);
    }
  return corners;
}

/// The corners of the face furthest along a direction, in order around it.
std::vector<mesh::Index> face_along(const core::Vector3& direction,
                                    const std::vector<core::Vector3>& corners) {
  double furthest = 0;
  for (const core::Vector3& corner : corners) furthest = std::max(furthest, corner.dot(direction));
  std::vector<mesh::Index> face;
  core::Vector3 middle = core::Vector3::Zero();
  for (std::size_t n = 0; n < corners.size(); ++n)
    if (corners[n].dot(direction) > furthest * (1 - 1e-9)) {
      face.push_back(static_cast<mesh::Index>(n));
      middle += corners[n];
    }
  middle /= static_cast<double>(face.size());
  const core::Vector3 u = (corners[face[0]] - middle).normalized(), v = direction.cross(u);
  std::ranges::sort(face, {}, [&](mesh::Index n) {
    const core::Vector3 arm = corners[n] - middle;
    return std::atan2(arm.dot(v), arm.dot(u));
  });
  return face;
}

}  // namespace

double eota_edge(double volume, bool flat) {
  return std::cbrt(volume * (flat ? 2 : 1) * 24.0 / 17);
}

mesh::Surface make_eota_block(const EotaBlock& block) {
  const std::vector<core::Vector3> corners = corners_of(block.edge);
  mesh::Surface surface;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const auto face = face_along(core::Vector3(x, y, z), corners);
        for (std::size_t k = 1; k + 1 < face.size(); ++k)
          surface.triangles.push_back({face[0], face[k], face[k + 1]});
      }
  for (core::Vector3 corner : corners) {
    if (block.flat) corner.z() *= 0.5;
    surface.positions.insert(surface.positions.end(), corner.data(), corner.data() + 3);
  }
  surface.parts = {{.name = "block", .triangle_end = static_cast<mesh::Index>(surface.triangles.size())}};
  return surface;
}

}  // namespace talus::dem
