#include "interface_mesh/closest_point.hpp"

#include <algorithm>

namespace talus::mesh {

namespace {

std::array<double, 3> weights_in_triangle(const core::Vector3& p,
                                          const std::array<core::Vector3, 3>& corners) noexcept {
  const auto& [a, b, c] = corners;
  const core::Vector3 ab = b - a, ac = c - a;
  const double a_along_ab = ab.dot(p - a), a_along_ac = ac.dot(p - a);
  if (a_along_ab <= 0 && a_along_ac <= 0) return {1, 0, 0};
  const double b_along_ab = ab.dot(p - b), b_along_ac = ac.dot(p - b);
  if (b_along_ab >= 0 && b_along_ac <= b_along_ab) return {0, 1, 0};
  const double c_along_ab = ab.dot(p - c), c_along_ac = ac.dot(p - c);
  if (c_along_ac >= 0 && c_along_ab <= c_along_ac) return {0, 0, 1};

  // Twice the areas of the sub-triangles opposite to c, b and a, times the triangle's own: negative outside
  // that edge.
  const double opposite_c = a_along_ab * b_along_ac - b_along_ab * a_along_ac;
  if (opposite_c <= 0 && a_along_ab >= 0 && b_along_ab <= 0) {
    const double t = a_along_ab / (a_along_ab - b_along_ab);
    return {1 - t, t, 0};
  }
  const double opposite_b = c_along_ab * a_along_ac - a_along_ab * c_along_ac;
  if (opposite_b <= 0 && a_along_ac >= 0 && c_along_ac <= 0) {
    const double t = a_along_ac / (a_along_ac - c_along_ac);
    return {1 - t, 0, t};
  }
  const double opposite_a = b_along_ab * c_along_ac - c_along_ab * b_along_ac;
  const double b_to_c = b_along_ac - b_along_ab, c_to_b = c_along_ab - c_along_ac;
  if (opposite_a <= 0 && b_to_c >= 0 && c_to_b >= 0) {
    const double t = b_to_c / (b_to_c + c_to_b);
    return {0, 1 - t, t};
  }
  const double all = opposite_a + opposite_b + opposite_c;
  const double v = opposite_b / all, w = opposite_c / all;
  return {1 - v - w, v, w};
}

}  // namespace

ClosestPoint<2> closest_on_segment(const core::Vector3& p,
                                   const std::array<core::Vector3, 2>& ends) noexcept {
  const auto& [a, b] = ends;
  const core::Vector3 ab = b - a;
  const double along = ab.dot(p - a), length_squared = ab.squaredNorm();
  const double t = length_squared > 0 ? std::clamp(along / length_squared, 0.0, 1.0) : 0.0;
  return {{1 - t, t}, ((1 - t) * a + t * b - p).squaredNorm()};
}

ClosestPoint<3> closest_on_triangle(const core::Vector3& p,
                                    const std::array<core::Vector3, 3>& corners) noexcept {
  const auto weights = weights_in_triangle(p, corners);
  const core::Vector3 closest = weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
  return {weights, (closest - p).squaredNorm()};
}

}  // namespace talus::mesh
