#include "interface_mesh/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus::mesh {

namespace {

/// Corners closer than this part of the extent are one; areas below its product with the extent squared are
/// none.
constexpr double nothing_of_extent = 1e-9;

double extent(const Polygon& polygon) {
  Vector2 low = polygon.front(), high = low;
  for (const auto& corner : polygon) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  return (high - low).norm();
}

/// Whether b lies between a and c, given that the three are on a line.
bool is_between(const Vector2& a, const Vector2& b, const Vector2& c) {
  return (b - a).dot(b - c) <= 0;
}

bool touch(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d) {
  const double abc = turn(a, b, c), abd = turn(a, b, d), cda = turn(c, d, a), cdb = turn(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && is_between(a, c, b)) || (abd == 0 && is_between(a, d, b)) ||
         (cda == 0 && is_between(c, a, d)) || (cdb == 0 && is_between(c, b, d));
}

}  // namespace

double signed_area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) twice += turn(polygon[0], polygon[k], polygon[k + 1]);
  return twice / 2;
}

bool contains(const Polygon& polygon, const Vector2& point) {
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if ((turn(a, b, point) > 0) == (b.y() > a.y())) inside = !inside;
  }
  return inside;
}

OutlinePoint closest_on_outline(const Polygon& polygon, const Vector2& point) {
  OutlinePoint best{.distance = std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2 start = polygon[k], edge = polygon[(k + 1) % polygon.size()] - start;
    const double share = std::clamp((point - start).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    const Vector2 at = share == 1 ? polygon[(k + 1) % polygon.size()] : Vector2(start + share * edge);
    const double distance = (at - point).norm();
    if (distance < best.distance) best = {k, share, at, distance};
  }
  return best;
}

std::optional<OutlineFault> find_fault(const Polygon& polygon) {
  using Kind = OutlineFault::Kind;
  const std::size_t count = polygon.size();
  if (count < 3) return OutlineFault{Kind::too_few_corners};
  const double size = extent(polygon);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      if ((polygon[i] - polygon[j]).norm() <= nothing_of_extent * size)
        return OutlineFault{Kind::repeated_corner, i, j};
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 2; j < count; ++j) {
      if (i == 0 && j == count - 1) continue;
      if (touch(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % count]))
        return OutlineFault{Kind::crossing_edges, i, j};
    }
  if (std::abs(signed_area(polygon)) <= nothing_of_extent * size * size) return OutlineFault{Kind::no_area};
  return std::nullopt;
}

}  // namespace talus::mesh
