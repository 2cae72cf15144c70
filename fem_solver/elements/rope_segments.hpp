#pragma once

#include <cstddef>
#include <span>

#include "fem_solver/elements/axial.hpp"

/// The straight pieces of a rope between its nodes.
namespace talus::fem {

/// A segment's length and direction, smooth down to length zero. With chord d from node k to k+1, r = |d|,
/// gap g:
///
///     r >= g:  l = r,                   t = dl/dd = d/r,    d2l/dd2 = (I - t t^T)/r
///     r <  g:  l = (r^2 + g^2)/(2 g),   t = dl/dd = d/g,    d2l/dd2 = I/g
///
/// | symbol | variable  | meaning                                                            | unit |
/// |--------|-----------|--------------------------------------------------------------------|------|
/// | d      | chord     | from the nearer to the farther node along the rope                 | m    |
/// | g      | gap       | size of the fitting where a slider stops; > 0                      | m    |
/// | l      | length    | r, but g/2 instead of 0 at coinciding nodes; smooth at r = g       | m    |
/// | t      | direction | dl/dd: unit vector, shorter inside the gap                         | 1    |
///
/// A slider that reaches the rope's end or its neighbour meets the tip of the cone r, where the direction
/// jumps from t to -t. In reality it stops at a fitting of finite size: within g the segment acts as a spring
/// of stiffness N/g towards coincidence. It is conservative, bounds the stiffness by N/g, and segments longer
/// than g do not notice. Proven by (elements_sliding.cpp): "a segment is as smooth at its gap as anywhere".
struct RopeSegment {
  Vector3 direction;
  double length = 0;
  double inverse_radius = 0;  ///< 1/max(r, g)
  bool inside_gap = false;

  RopeSegment(const Vector3& chord, double gap) noexcept {
    const double r = chord.norm();
    inside_gap = r < gap;
    inverse_radius = 1 / (inside_gap ? gap : r);
    length = inside_gap ? 0.5 * (r * r * inverse_radius + gap) : r;
    direction = chord * inverse_radius;
  }

  /// d2l/dd2 (1/m)
  Matrix3 curvature() const noexcept {
    Matrix3 result = Matrix3::Identity();
    if (!inside_gap) result -= direction * direction.transpose();
    return result * inverse_radius;
  }
  /// d2l/dd2 times a change of the chord.
  Vector3 curvature_product(const Vector3& change) const noexcept {
    const Vector3 across = inside_gap ? change : Vector3(change - direction.dot(change) * direction);
    return across * inverse_radius;
  }
};

/// The chords of a rope whose nodes are stored one behind the other, 3 numbers a node.
class StackedChords {
 public:
  explicit StackedChords(std::span<const double> positions) : positions_(positions) {}
  std::size_t size() const noexcept { return positions_.size() / 3 - 1; }
  Vector3 operator()(std::size_t segment) const noexcept {
    const double* near = &positions_[3 * segment];
    return Vector3::Map(near + 3) - Vector3::Map(near);
  }

 private:
  std::span<const double> positions_;
};

}  // namespace talus::fem
