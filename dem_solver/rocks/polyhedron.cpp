#include "dem_solver/rocks/polyhedron.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <vector>

#include "dem_solver/rocks/surface_nodes.hpp"

namespace talus::dem {

VolumeMoments polyhedron_moments(const mesh::Surface& surface) {
  VolumeMoments total;
  for (const auto& t : surface.triangles) {
    const core::Vector3 a = node(surface, t[0]), b = node(surface, t[1]), c = node(surface, t[2]),
                        s = a + b + c;
    const double volume = a.dot(b.cross(c)) / 6;
    total.volume += volume;
    total.first += volume / 4 * s;
    total.second +=
        volume / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  }
  return total;
}

double block_edge(double volume, double cut) {
  return std::cbrt(volume / (1 - 4.0 / 3 * cut * cut * cut));
}

mesh::Surface make_block(const BlockShape& shape) {
  // Each corner of the cube becomes three nodes, on the edges along x, y and z.
  const double h = 0.5 * shape.edge, inner = h - shape.cut * shape.edge;
  mesh::Surface surface;
  const auto corner = [](int sx, int sy, int sz) {
    return static_cast<mesh::Index>(3 * (sx + 2 * sy + 4 * sz));
  };
  for (int k = 0; k < 8; ++k) {
    const core::Vector3 s(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    for (int axis = 0; axis < 3; ++axis) {
      core::Vector3 p = h * s;
      p[axis] = inner * s[axis];
      surface.positions.insert(surface.positions.end(), p.data(), p.data() + 3);
    }
  }
  const auto add = [&](mesh::Index a, mesh::Index b, mesh::Index c) {
    const core::Vector3 p = node(surface, a), n = (node(surface, b) - p).cross(node(surface, c) - p);
    if (n.dot(p) > 0)
      surface.triangles.push_back({a, b, c});  // the block is convex about the origin
    else
      surface.triangles.push_back({a, c, b});
  };
  for (mesh::Index k = 0; k < 8; ++k) add(3 * k, 3 * k + 1, 3 * k + 2);
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      std::vector<mesh::Index> ring;  // the octagon of this face, in order
      for (const auto& [su, sv] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
        std::array<int, 3> s{};
        s[axis] = side;
        s[u] = su;
        s[v] = sv;
        const mesh::Index k = corner(s[0], s[1], s[2]);
        const bool along_u_next = su == sv;  // leaving (0, 0) and (1, 1) along u, the others along v
        ring.push_back(k + (along_u_next ? v : u));
        ring.push_back(k + (along_u_next ? u : v));
      }
      for (std::size_t i = 1; i + 1 < ring.size(); ++i) add(ring[0], ring[i], ring[i + 1]);
    }
  surface.parts = {{.name = "block", .triangle_end = static_cast<mesh::Index>(surface.triangles.size())}};
  return surface;
}

}  // namespace talus::dem
