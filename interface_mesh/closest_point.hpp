#pragma once

#include <array>

#include "core/vector3.hpp"

namespace talus::mesh {

/// The point of a feature nearest to a given one, as weights of the feature's corners: not negative, sum 1,
/// and exactly 0 or 1 where an edge or a corner is the nearest.
template <std::size_t corners>
struct ClosestPoint {
  std::array<double, corners> weights{};
  double distance_squared = 0;  ///< m^2
};

/// Orthogonal projection onto the line a-b, clamped to the segment.
///     t = (p - a).(b - a) / |b - a|^2,  weights (1 - t, t),  0 <= t <= 1
/// A segment without length counts as its point a. Test: "the closest point of a segment ..." in
/// closest_point_test.cpp.
ClosestPoint<2> closest_on_segment(const core::Vector3& p, const std::array<core::Vector3, 2>& ends) noexcept;

/// Closest point of a triangle a, b, c by the regions of its corners, edges and face (C. Ericson, Real-Time
/// Collision Detection, 2005, section 5.1.5): each region is told by the signs of the projections of p - a, p
/// - b and p - c on the edges.
/// @pre the triangle has an area. Test: "the closest point of a triangle ..." in closest_point_test.cpp.
ClosestPoint<3> closest_on_triangle(const core::Vector3& p,
                                    const std::array<core::Vector3, 3>& corners) noexcept;

}  // namespace talus::mesh
