#pragma once

namespace talus::dem {

/// A place in a plane.
struct Place {
  double x = 0, y = 0;
};

/// Twice the signed area of a, b, p: positive where they turn counter-clockwise; rounded.
inline double turn(const Place& a, const Place& b, const Place& p) noexcept {
  return (a.x - p.x) * (b.y - p.y) - (a.y - p.y) * (b.x - p.x);
}

/// On which side of the line from a to b a place p lies: 1 left, -1 right, exactly. What lies on the line
/// counts as if it were moved by an infinitely small step along x and one that is much smaller still along y,
/// so that no place is on the line between two others and every line divides the plane in two. 0 where a and
/// b are the same place. (J. Shewchuk, Adaptive precision floating-point arithmetic, 1997; H. Edelsbrunner
/// and E. Mücke, Simulation of simplicity, 1990.)
int side_of_line(const Place& a, const Place& b, const Place& p) noexcept;

}  // namespace talus::dem
