#pragma once

#include "fem_solver/elements/axial.hpp"

namespace talus::fem {

/// A node on a fixed plane: a penalty against going through, and Coulomb friction by a spring on a sticking point.
///
///     g = c - n.(x - o), at least 0      N = k g      s = P (x - a),   P = I - n n^T
///     |k s| <= mu N: it sticks;  else a moves along until |k s| = mu N
///     f = dU/dx = -k g n + k s           U = k g^2/2 + k |s|^2/2
///     dissipated by a move da of a: k (s_before + s_after)/2 . da
///
/// | symbol | variable    | meaning                                                              | unit |
/// |--------|-------------|----------------------------------------------------------------------|------|
/// | x      | place       | of the node                                                          | m    |
/// | o, n   | point, normal | of the plane; n is a unit vector to the side where nodes may be    | m, 1 |
/// | c      | distance    | that the node keeps, such as the radius of its rope                  | m    |
/// | k      | stiffness   | across and along; the depth left is force/k                          | N/m  |
/// | a      | anchor      | where the node would have no friction force                          | m    |
/// | s      | stretch     | of the tangential spring                                             | m    |
///
/// A node that leaves the plane loses its spring. Proven by (obstacle_test.cpp): "the force of a plane is the
/// derivative of its energy", "a block on an incline slides as Coulomb's law says".
struct PlaneContact {
  Vector3 point, normal;
  double distance = 0;   ///< m
  double friction = 0;   ///< mu
  double stiffness = 0;  ///< N/m

  /// What a node remembers of the plane.
  struct Memory {
    Vector3 anchor = Vector3::Zero(), stretch = Vector3::Zero();  ///< m
    bool touches = false;
    double dissipated = 0;  ///< J
  };

  double depth(const Vector3& place) const noexcept {
    return std::max(0.0, distance - normal.dot(place - point));
  }
  Vector3 along(const Vector3& v) const noexcept { return v - normal * normal.dot(v); }

  /// Internal force of the spring across (N).
  Vector3 pressing(const Vector3& place) const noexcept { return -stiffness * depth(place) * normal; }

  /// The memory once this place is accepted.
  Memory follow(const Vector3& place, const Memory& before) const noexcept {
    Memory after = before;
    after.touches = depth(place) > 0;
    const Vector3 trial = before.touches ? along(place - before.anchor) : Vector3(Vector3::Zero());
    const double most = friction * depth(place), size = trial.norm();
    after.stretch = size > most ? Vector3(most / size * trial) : trial;
    const Vector3 slip = trial - after.stretch;
    after.anchor = before.touches ? Vector3(before.anchor + slip) : place;
    after.dissipated += 0.5 * stiffness * (along(before.stretch) + after.stretch).dot(slip);
    return after;
  }

  double energy(const Vector3& place, const Memory& memory) const noexcept {
    const double g = depth(place);
    const Vector3 s = memory.touches ? along(place - memory.anchor) : Vector3(Vector3::Zero());
    return 0.5 * stiffness * (g * g + s.squaredNorm());
  }

  /// Derivative of the force while the node sticks, and while it slides: without what friction changes with the
  /// pressure, so that it stays symmetric.
  Matrix3 tangent(const Vector3& place, const Memory& before) const noexcept {
    if (!(depth(place) > 0)) return Matrix3::Zero();
    Matrix3 K = stiffness * normal * normal.transpose();
    if (!(friction > 0) || !before.touches) return K;  // a node that arrives has no spring along yet
    const Matrix3 P = Matrix3::Identity() - normal * normal.transpose();
    const Vector3 trial = along(place - before.anchor);
    const double most = friction * depth(place), size = trial.norm();
    if (!(size > most)) return K + stiffness * P;
    const Vector3 t = trial / size;
    return K + (stiffness * most / size) * (P - t * t.transpose());
  }
  /// As if the node touched and stuck: what no state of it exceeds.
  Matrix3 stiffest() const noexcept {
    return friction > 0 ? Matrix3(stiffness * Matrix3::Identity())
                        : Matrix3(stiffness * normal * normal.transpose());
  }
};

}  // namespace talus::fem
