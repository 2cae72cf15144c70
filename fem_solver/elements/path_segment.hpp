#pragma once

#include "fem_solver/materials/axial_laws.hpp"

namespace talus::fem {

/// Two-node element along whose axis a law with memory acts: brakes, elastic-plastic ropes.
///
///     f = N(l, history) t on the far node, -f on the near one      K = (dN/dl) t t^T + (N/l)(I - t t^T)
///
/// | symbol | variable  | meaning                                                   | unit |
/// |--------|-----------|-----------------------------------------------------------|------|
/// | d      | chord     | from the near to the far node, current state; l = |d|     | m    |
/// | t      |           | d/l                                                       | 1    |
/// | L      | reference | reference length                                          | m    |
///
/// `history` is the value at the step's start; the answer holds the one to keep if the step is accepted.
/// Valid for l > 0; a segment squeezed to nothing is slack.
/// Proven by (elements_axial_laws.cpp): "the stiffness of a segment with memory is the derivative of its
/// force".
template <class Law>
struct PathSegment {
  const Law& law;
  double reference = 0;

  AxialResponse respond(const Vector3& chord, double history) const noexcept {
    return law.respond({chord.norm(), reference}, history);
  }
  Vector3 force(const Vector3& chord, const AxialResponse& response) const noexcept {
    const double l = chord.norm();
    return l > 0 ? Vector3(response.force / l * chord) : Vector3(Vector3::Zero());
  }
  Matrix3 stiffness(const Vector3& chord, const AxialResponse& response) const noexcept {
    const double l = chord.norm();
    if (!(l > 0)) return Matrix3::Zero();
    const Vector3 t = chord / l;
    const double across = response.force / l;
    return (response.slope - across) * t * t.transpose() + across * Matrix3::Identity();
  }
  double stored(const Vector3& chord, double history) const noexcept {
    return law.stored({chord.norm(), reference}, history);
  }
  double dissipated(const Vector3& chord, double history) const noexcept {
    return law.dissipated({chord.norm(), reference}, history);
  }
};

}  // namespace talus::fem
