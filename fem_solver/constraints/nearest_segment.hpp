#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "core/vector3.hpp"

namespace talus::fem {

using core::Vector3;

/// The point of a polyline that is nearest to a given one.
struct NearestSegment {
  std::size_t segment = 0;      ///< from node `segment` to the next one
  double fraction = 0;          ///< of the segment's length, 0 at its first node, 1 at its second
  double squared_distance = 0;  ///< m^2
};

/// The foot of C on the segment from A to B, as a fraction clamped to [0, 1].
inline double foot_fraction(const Vector3& A, const Vector3& B, const Vector3& C) noexcept {
  const Vector3 w = B - A;
  return std::clamp((C - A).dot(w) / w.squaredNorm(), 0.0, 1.0);
}

/// Searches every segment; of equally near segments the first counts. About 5 ns a segment, ropes have tens of them:
/// no tree would pay.
/// @param node a callable giving node k's position (m) for k = 0..segments
/// @pre no two consecutive nodes coincide
template <class Node>
NearestSegment nearest_segment(std::size_t segments, const Node& node, const Vector3& C) noexcept {
  NearestSegment best{.squared_distance = std::numeric_limits<double>::infinity()};
  Vector3 A = node(std::size_t{0});
  for (std::size_t i = 0; i < segments; ++i) {
    const Vector3 B = node(i + 1);
    const double t = foot_fraction(A, B, C), squared = (C - A - t * (B - A)).squaredNorm();
    if (squared < best.squared_distance) best = {i, t, squared};
    A = B;
  }
  return best;
}

/// A polyline as a search needs it.
struct Segments {
  std::size_t count = 0;
  bool closed = false;  ///< the last one is followed by the first
};

/// Goes from a segment to its neighbours as long as one of them is nearer: a slider stays on the stretch of rope
/// that it is on, also where another part of the rope comes close, and the price does not depend on the rope.
template <class Node>
NearestSegment nearest_segment_from(std::size_t segment, const Segments& segments, const Node& node,
                                    const Vector3& C) noexcept {
  const auto measured = [&](std::size_t i) {
    const Vector3 A = node(i), B = node(i + 1);
    const double t = foot_fraction(A, B, C);
    return NearestSegment{i, t, (C - A - t * (B - A)).squaredNorm()};
  };
  NearestSegment best = measured(segment);
  for (std::size_t count = 0; count < segments.count; ++count) {
    const std::size_t here = best.segment, last = segments.count - 1;
    if (here > 0 || segments.closed)
      if (const auto before = measured(here > 0 ? here - 1 : last);
          before.squared_distance < best.squared_distance)
        best = before;
    if (here < last || segments.closed)
      if (const auto after = measured(here < last ? here + 1 : 0);
          after.squared_distance < best.squared_distance)
        best = after;
    if (best.segment == here) break;
  }
  return best;
}

}  // namespace talus::fem
