#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "fem_solver/elements/rope_friction.hpp"
#include "fem_solver/elements/rope_segments.hpp"

namespace talus::fem {

/// A rope that runs over its inner nodes with friction. Source: [P, after eq. 4], capstan limit by material
/// lengths (rope_friction.hpp). The same sums as SlidingCable, with each segment's own tension:
///
///     N_i = N(l_i/M_i)     f_k = N_(k-1) t_(k-1) - N_k t_k     U = sum M_i u(l_i/M_i)
///
/// The material M is the history: settle() moves it from what the step began with to what the present
/// positions ask for, and the force follows from it. Each inner node has its own friction, infinite where the
/// rope is clamped. Friction makes the derivative of that force, `stiffness`, unsymmetric. With the material held
/// (nothing slips) the rope is as stiff as it can be, and its stiffness symmetric: `held_stiffness_product`, for
/// step limits. Proven by (elements_friction.cpp): "the stiffness of a frictional cable is the derivative of its
/// settled force".
class FrictionalCable {
 public:
  struct Properties {
    RopeLaw law;
    std::vector<double> friction;  ///< mu of the capstan equation at each inner node; infinite: clamped
    double gap = 0;                ///< m
  };
  explicit FrictionalCable(Properties properties) : properties_(std::move(properties)) {}

  /// Finds `material` for the current chords from the material at the step's start (m).
  /// @return false where a chord or material is not finite
  template <class Chords>
  bool settle(const Chords& chords, std::span<const double> old_material, std::span<double> material) const {
    Workspace& space = measured(chords);
    return space.friction.settle(properties_.law, space.state(), old_material, material);
  }

  template <class Chords>
  double energy(const Chords& chords, std::span<const double> material) const noexcept {
    double sum = 0;
    for (std::size_t i = 0; i < chords.size(); ++i)
      sum += material[i] * properties_.law.energy_per_length(length(chords(i)) / material[i]);
    return sum;
  }
  double stretch(const Vector3& chord, double material) const noexcept { return length(chord) / material; }
  double tension(const Vector3& chord, double material) const noexcept {
    return properties_.law.tension(length(chord) / material);
  }

  /// sink(i, force): what segment i pulls its farther node back with. N.
  template <class Chords, class Sink>
  void segment_forces(const Chords& chords, std::span<const double> material,
                      const Sink& sink) const noexcept {
    for (std::size_t i = 0; i < chords.size(); ++i) {
      const RopeSegment segment(chords(i), properties_.gap);
      sink(i, Vector3(properties_.law.tension(segment.length / material[i]) * segment.direction));
    }
  }

  /// The change of segment_forces along a change of the chords with the material held, slack segments as if
  /// taut.
  template <class Chords, class ChordChanges, class Sink>
  void held_stiffness_product(const Chords& chords, const ChordChanges& changes,
                              std::span<const double> material, const Sink& sink) const noexcept {
    for (std::size_t i = 0; i < chords.size(); ++i) {
      const RopeSegment segment(chords(i), properties_.gap);
      const Vector3 change = changes(i);
      const double q = segment.length / material[i];
      const double N_change = properties_.law.taut_slope(q) / material[i] * segment.direction.dot(change);
      sink(i, Vector3(N_change * segment.direction +
                      properties_.law.tension(q) * segment.curvature_product(change)));
    }
  }

  /// What resists a change of each segment's length with the material held, as a rate's force does: slack ones
  /// nothing. N/m along the segment.
  double material_slope(const RopeSegment& segment, double material) const noexcept {
    return properties_.law.tension_slope(segment.length / material) / material;
  }
  template <class Chords, class ChordChanges, class Sink>
  void material_product(const Chords& chords, const ChordChanges& changes, std::span<const double> material,
                        const Sink& sink) const noexcept {
    for (std::size_t i = 0; i < chords.size(); ++i) {
      const RopeSegment segment(chords(i), properties_.gap);
      sink(i, Vector3(material_slope(segment, material[i]) * segment.direction.dot(changes(i)) *
                      segment.direction));
    }
  }
  /// Every pair once, in the order of `stiffness`.
  template <class Chords, class Sink>
  void material_stiffness(const Chords& chords, std::span<const double> material, const Sink& sink) const {
    for (std::size_t j = 0; j < chords.size(); ++j) {
      const RopeSegment segment(chords(j), properties_.gap);
      const Matrix3 own =
          material_slope(segment, material[j]) * segment.direction * segment.direction.transpose();
      for (std::size_t i = 0; i < chords.size(); ++i) sink(i, j, i == j ? own : Matrix3(Matrix3::Zero()));
    }
  }

  /// sink(i, j, block): derivative of segment i's settled force with respect to chord j. Every pair once;
  /// allocates. @param old_material at the step's start (m)
  template <class Chords, class Sink>
  void stiffness(const Chords& chords, std::span<const double> old_material, const Sink& sink) const {
    const std::size_t m = chords.size();
    std::vector<double> material(m);
    settle(chords, old_material, material);
    Workspace& space = workspace();
    std::vector<double> length_changes(m), grip_changes(m - 1), tension_changes(m);
    for (std::size_t j = 0; j < m; ++j) {
      std::vector<Matrix3> blocks(m, Matrix3::Zero());
      for (int axis = 0; axis < 3; ++axis) {
        length_changes.assign(m, 0.0);
        grip_changes.assign(m - 1, 0.0);
        length_changes[j] = RopeSegment(chords(j), properties_.gap).direction[axis];
        if (j > 0)
          grip_changes[j - 1] = grip_slope(space, j - 1) * wrap_slope(chords(j), chords(j - 1))[axis];
        if (j + 1 < m) grip_changes[j] = grip_slope(space, j) * wrap_slope(chords(j), chords(j + 1))[axis];
        space.friction.tension_changes(properties_.law, space.state(), material,
                                       {length_changes, grip_changes}, tension_changes);
        for (std::size_t i = 0; i < m; ++i)
          blocks[i].col(axis) = tension_changes[i] * RopeSegment(chords(i), properties_.gap).direction;
      }
      blocks[j] += tension(chords(j), material[j]) * RopeSegment(chords(j), properties_.gap).curvature();
      for (std::size_t i = 0; i < m; ++i) sink(i, j, blocks[i]);
    }
  }

  double gap() const noexcept { return properties_.gap; }  ///< m

 private:
  double length(const Vector3& chord) const noexcept { return RopeSegment(chord, properties_.gap).length; }

  /// What one answer needs besides the state; the same memory for all ropes of a thread.
  struct Workspace {
    RopeFriction friction;
    std::vector<double> lengths, grips;  ///< m, 1
    RopeState state() const noexcept { return {lengths, grips}; }
  };
  static Workspace& workspace() {
    thread_local Workspace space;
    return space;
  }
  template <class Chords>
  Workspace& measured(const Chords& chords) const {
    Workspace& space = workspace();
    const std::size_t m = chords.size();
    space.friction.resize(m);
    space.lengths.resize(m);
    space.grips.resize(m - 1);
    for (std::size_t i = 0; i < m; ++i) space.lengths[i] = length(chords(i));
    for (std::size_t k = 0; k + 1 < m; ++k) space.grips[k] = grip(k, wrap_angle(chords(k), chords(k + 1)));
    return space;
  }
  /// A clamped node holds a straight rope too.
  double grip(std::size_t node, double angle) const noexcept {
    const double mu = properties_.friction[node];
    return std::isinf(mu) ? mu : std::exp(mu * angle);
  }
  /// d grip/d angle; a clamped node has none that counts, as it never slips.
  double grip_slope(const Workspace& space, std::size_t node) const noexcept {
    const double mu = properties_.friction[node];
    return std::isinf(mu) ? 0 : space.grips[node] * mu;
  }
  /// Angle between two chords, 0 to pi; exact for small angles too.
  static double wrap_angle(const Vector3& near, const Vector3& far) noexcept {
    return std::atan2(near.cross(far).norm(), near.dot(far));
  }
  /// Derivative of the wrap angle with respect to `chord`; zero for a straight rope, where the angle has a
  /// kink.
  static Vector3 wrap_slope(const Vector3& chord, const Vector3& other) noexcept {
    const double r2 = chord.squaredNorm(), sine = chord.cross(other).norm();
    if (!(sine > 1e-9 * std::sqrt(r2) * other.norm())) return Vector3::Zero();
    return -(other - chord * (chord.dot(other) / r2)) / sine;
  }

  Properties properties_;
};

}  // namespace talus::fem
