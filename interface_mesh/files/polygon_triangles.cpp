#include "interface_mesh/files/polygon_triangles.hpp"

#include <Eigen/Geometry>

#include "core/errors.hpp"
#include "interface_mesh/triangulation.hpp"

namespace talus::mesh {

using core::Vector3;

namespace {

std::vector<std::size_t> distinct_corners(const std::vector<Vector3>& corners) {
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (kept.empty() || corners[k] != corners[kept.back()]) kept.push_back(k);
  while (kept.size() > 1 && corners[kept.back()] == corners[kept.front()]) kept.pop_back();
  return kept;
}

/// Twice the area, across it (M. Newell); exact for any flat polygon.
Vector3 area_vector(const std::vector<Vector3>& corners, const std::vector<std::size_t>& kept) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 1; k + 1 < kept.size(); ++k)
    sum += (corners[kept[k]] - corners[kept[0]]).cross(corners[kept[k + 1]] - corners[kept[0]]);
  return sum;
}

/// In the plane across `normal`, seen against it.
Polygon flattened(const std::vector<Vector3>& corners, const std::vector<std::size_t>& kept,
                  const Vector3& normal) {
  const Vector3 along = normal.unitOrthogonal(), across = normal.cross(along);
  Polygon flat;
  for (const std::size_t k : kept) {
    const Vector3 from_first = corners[k] - corners[kept[0]];
    flat.emplace_back(from_first.dot(along), from_first.dot(across));
  }
  return flat;
}

bool first_diagonal_is_inside(const Polygon& quadrangle) {
  return turn(quadrangle[0], quadrangle[1], quadrangle[2]) > 0 &&
         turn(quadrangle[0], quadrangle[2], quadrangle[3]) > 0;
}

}  // namespace

CutPolygon cut_polygon(const std::vector<Vector3>& corners) {
  if (corners.size() == 3) return {{{0, 1, 2}}, {}};
  const auto kept = distinct_corners(corners);
  if (kept.size() < 3) return {{}, "has fewer than three corners at different places"};
  if (kept.size() == 3) return {{{kept[0], kept[1], kept[2]}}, {}};
  const Vector3 area = area_vector(corners, kept);
  if (!(area.norm() > 0)) return {{}, "has no area"};
  const Polygon flat = flattened(corners, kept, area.normalized());
  if (kept.size() == 4 && first_diagonal_is_inside(flat))
    return {{{kept[0], kept[1], kept[2]}, {kept[0], kept[2], kept[3]}}, {}};
  if (find_fault(flat)) return {{}, "crosses or touches itself"};
  CutPolygon cut;
  try {
    for (const auto& triangle : Triangulation(flat).triangles()) {
      const auto corner = [&](std::size_t k) { return kept[static_cast<std::size_t>(triangle[k])]; };
      cut.triangles.push_back({corner(0), corner(1), corner(2)});
    }
  } catch (const core::ConfigError&) {
    return {{}, "crosses or nearly touches itself"};
  }
  return cut;
}

}  // namespace talus::mesh
