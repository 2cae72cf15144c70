#include "dem_solver/rocks/crossing_triangles.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "dem_solver/rocks/surface_nodes.hpp"

namespace talus::dem {

using core::Vector3;

namespace {

/// The sign of the volume that u, v, w span; 0 where round-off could have made it (J. Shewchuk 1997, the
/// first bound of orient3d: differences of coordinates are taken before).
int side(const Vector3& u, const Vector3& v, const Vector3& w) {
  const Vector3 across = v.cross(w);
  const Vector3 terms(std::abs(v.y() * w.z()) + std::abs(v.z() * w.y()),
                      std::abs(v.z() * w.x()) + std::abs(v.x() * w.z()),
                      std::abs(v.x() * w.y()) + std::abs(v.y() * w.x()));
  constexpr double round_off = 8e-16;
  const double volume = u.dot(across);
  if (std::abs(volume) <= round_off * u.cwiseAbs().dot(terms)) return 0;
  return volume > 0 ? 1 : -1;
}

/// Whether p and q are further from a plane than what rounding of a flat surface's coordinates makes.
bool stand_off(const Vector3& p, const Vector3& q, const Face& f) {
  constexpr double flat = 1e-9;
  const auto& [a, b, c] = f.corners;
  const Vector3 normal = (b - a).cross(c - a).normalized();
  return std::min(std::abs(normal.dot(p - a)), std::abs(normal.dot(q - a))) > flat * (q - p).norm();
}

/// Whether p-q passes through the face from one side to the other, be it through one of its edges or corners.
bool pierces(const Vector3& p, const Vector3& q, const Face& f) {
  const auto& [a, b, c] = f.corners;
  if (side(p - a, b - a, c - a) * side(q - a, b - a, c - a) != -1) return false;
  const auto [least, most] =
      std::minmax({side(q - p, a - p, b - p), side(q - p, b - p, c - p), side(q - p, c - p, a - p)});
  if (least == -most) return false;  // past the face; or all are zero: within its plane
  return least * most != 0 || stand_off(p, q, f);
}

/// Edges that begin or end at a corner of the other triangle touch it there, and go no further into it.
bool edges_pierce(const Face& edges, const Face& f) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (f.has(edges.nodes[k]) || f.has(edges.nodes[next])) continue;
    if (pierces(edges.corners[k], edges.corners[next], f)) return true;
  }
  return false;
}

}  // namespace

bool Face::has(mesh::Index node) const {
  return std::ranges::count(nodes, node) > 0;
}

Face face(const mesh::Surface& surface, std::int32_t triangle) {
  const auto& t = surface.triangles[triangle];
  const auto corner = [&](int k) { return node(surface, t[k]); };
  return {t, {corner(0), corner(1), corner(2)}};
}

bool cross_each_other(const Face& f, const Face& g) {
  return edges_pierce(f, g) || edges_pierce(g, f);
}

}  // namespace talus::dem
