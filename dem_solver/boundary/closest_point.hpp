#pragma once

#include "dem_solver/particles/row.hpp"

namespace talus::dem {

/// Linear weights of the point of a segment (third weight 0) or triangle that is closest to a given point.
/// They are >= 0 and add up to 1.
struct Weights {
  double a = 0, b = 0, c = 0;
};

/// Projection onto a-b, clamped to the ends. @pre a != b
Weights closest_on_segment(const Triple<double>& p, const Triple<double>& a,
                           const Triple<double>& b) noexcept;

/// Closest point of triangle a-b-c by the Voronoi region the point lies in (Ericson, Real-Time Collision
/// Detection, 2005, section 5.1.5).
/// @pre the triangle has an area
Weights closest_on_triangle(const Triple<double>& p, const Triple<double>& a, const Triple<double>& b,
                            const Triple<double>& c) noexcept;

}  // namespace talus::dem
