#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

/// Simple polygons in the plane: outlines of panels. Edge k runs from corner k to corner k + 1.
namespace talus::mesh {

using Vector2 = Eigen::Vector2d;
using Polygon = std::vector<Vector2>;

/// Twice the signed area of a, b, c (m^2): positive where they turn counter-clockwise.
inline double turn(const Vector2& a, const Vector2& b, const Vector2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// m^2; positive where the corners run counter-clockwise.
double signed_area(const Polygon& polygon);

/// Whether the point is inside; points on the outline may count either way.
bool contains(const Polygon& polygon, const Vector2& point);

struct OutlinePoint {
  std::size_t edge = 0;
  double share = 0;  ///< of the edge's length, from its first corner
  Vector2 at = Vector2::Zero();
  double distance = 0;  ///< m; from the point that was asked for
};
OutlinePoint closest_on_outline(const Polygon& polygon, const Vector2& point);

/// Why a polygon is no outline.
struct OutlineFault {
  enum class Kind { too_few_corners, repeated_corner, crossing_edges, no_area } kind;
  std::size_t first = 0, second = 0;  ///< corners (repeated_corner) or edges (crossing_edges)
};
/// The first fault found, or nothing. Edges that touch count as crossing.
std::optional<OutlineFault> find_fault(const Polygon& polygon);

}  // namespace talus::mesh
