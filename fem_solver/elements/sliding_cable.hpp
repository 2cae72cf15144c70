#pragma once

#include "fem_solver/elements/rope_segments.hpp"
#include "fem_solver/materials/rope_law.hpp"

namespace talus::fem {

/// A rope that runs freely through all its inner nodes: one element, any number of nodes. Source: [P eq. 3,
/// 4].
///
///     l = sum l_i     L = sum L_i     N = N(l/L)     U = L u(l/L)     t_i = dl_i/dx_(i+1)
///     f_k = dU/dx_k = N T_k,   T_1 = -t_1,   T_k = t_(k-1) - t_k,   T_n = t_(n-1)
///     K = (dN/dl) T T^T + sum_i N (d2 l_i/dx2),   dN/dl = (E A/L)(1 + 3 e + S_pre/E)
///
/// | symbol   | variable         | meaning                                             | unit |
/// |----------|------------------|-----------------------------------------------------|------|
/// | l_i, t_i | segment          | current length and direction of segment i           | m, 1 |
/// | L        | reference_length | the whole rope, reference state                     | m    |
/// | N        | tension          | the same in all segments: sliding costs nothing     | N    |
/// | f_k      | force            | internal force of node k: it must be held with it   | N    |
///
/// Valid for any shape; straight ropes have T_k = 0, slack ones no force. Segments shorter than the gap:
/// rope_segments.hpp. Chords: a callable with size(), giving the vector from node k to node k + 1 in the
/// current state (m). Proven by (elements_sliding.cpp): "the force of a sliding cable is the derivative of
/// its energy and its stiffness that of its force".
struct SlidingCable {
  RopeLaw law;
  double reference_length = 0;  ///< m
  double gap = 0;               ///< m

  template <class Chords>
  double length(const Chords& chords) const noexcept {
    double sum = 0;
    for (std::size_t i = 0; i < chords.size(); ++i) sum += RopeSegment(chords(i), gap).length;
    return sum;
  }
  template <class Chords>
  double energy(const Chords& chords) const noexcept {
    return reference_length * law.energy_per_length(length(chords) / reference_length);
  }
  template <class Chords>
  double tension(const Chords& chords) const noexcept {
    return law.tension(length(chords) / reference_length);
  }

  /// sink(i, force): what segment i pulls its farther node back with; its nearer node is pulled by minus
  /// that. N.
  template <class Chords, class Sink>
  void segment_forces(const Chords& chords, const Sink& sink) const noexcept {
    const double N = tension(chords);
    for (std::size_t i = 0; i < chords.size(); ++i)
      sink(i, Vector3(N * RopeSegment(chords(i), gap).direction));
  }

  /// The change of segment_forces along a change of the chords.
  template <class Chords, class Changes, class Sink>
  void stiffness_product(const Chords& chords, const Changes& changes, const Sink& sink) const noexcept {
    const double q = length(chords) / reference_length;
    product(chords, changes, {law.tension(q), law.tension_slope(q)}, sink);
  }
  /// The part of it that resists a change of the rope's length, as a rate's force does.
  template <class Chords, class Changes, class Sink>
  void material_product(const Chords& chords, const Changes& changes, const Sink& sink) const noexcept {
    product(chords, changes, {0, law.tension_slope(length(chords) / reference_length)}, sink);
  }
  template <class Chords, class Sink>
  void material_stiffness(const Chords& chords, const Sink& sink) const {
    const double slope = law.tension_slope(length(chords) / reference_length) / reference_length;
    for (std::size_t i = 0; i < chords.size(); ++i)
      for (std::size_t j = 0; j < chords.size(); ++j)
        sink(i, j,
             Matrix3(slope * RopeSegment(chords(i), gap).direction *
                     RopeSegment(chords(j), gap).direction.transpose()));
  }
  /// The same as if a slack rope were taut: what it may snap to, for step limits.
  template <class Chords, class Changes, class Sink>
  void taut_stiffness_product(const Chords& chords, const Changes& changes, const Sink& sink) const noexcept {
    const double q = length(chords) / reference_length;
    product(chords, changes, {law.tension(q), law.taut_slope(q)}, sink);
  }

  /// sink(i, j, block): derivative of segment i's force with respect to chord j. Every pair (i, j) once, in
  /// order.
  template <class Chords, class Sink>
  void stiffness(const Chords& chords, const Sink& sink) const {
    const double q = length(chords) / reference_length;
    const double N = law.tension(q), slope = law.tension_slope(q) / reference_length;
    for (std::size_t i = 0; i < chords.size(); ++i) {
      const RopeSegment near(chords(i), gap);
      for (std::size_t j = 0; j < chords.size(); ++j) {
        Matrix3 block = slope * near.direction * RopeSegment(chords(j), gap).direction.transpose();
        if (i == j) block += N * near.curvature();
        sink(i, j, block);
      }
    }
  }

 private:
  struct Axial {
    double tension, slope;  // N, dN/dq
  };
  template <class Chords, class Changes, class Sink>
  void product(const Chords& chords, const Changes& changes, const Axial& axial,
               const Sink& sink) const noexcept {
    double stretching = 0;
    for (std::size_t i = 0; i < chords.size(); ++i)
      stretching += RopeSegment(chords(i), gap).direction.dot(changes(i));
    const double tension_change = axial.slope / reference_length * stretching;
    for (std::size_t i = 0; i < chords.size(); ++i) {
      const RopeSegment segment(chords(i), gap);
      sink(i, Vector3(tension_change * segment.direction +
                      axial.tension * segment.curvature_product(changes(i))));
    }
  }
};

}  // namespace talus::fem
