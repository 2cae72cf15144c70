#pragma once

#include <Eigen/Core>

#include "core/vector3.hpp"

/// Energy, force, stiffness and mass of a straight segment between two nodes that carries an axial stress
/// only: bar and cable.
namespace talus::fem {

using core::Vector3;
using Matrix3 = Eigen::Matrix3d;

/// The elastic law of an axial element, the same for a whole part.
struct AxialSection {
  double area = 0;            ///< m^2, of the reference state
  double youngs_modulus = 0;  ///< Pa, between Green-Lagrange strain and second Piola-Kirchhoff stress
  double prestress = 0;       ///< Pa, second Piola-Kirchhoff; positive in tension
};

/// What happens when the stress turns negative: a bar carries it, a cable goes slack.
struct CarriesCompression {
  static constexpr const char* called = "bars";
  static constexpr double stress(double trial) noexcept { return trial; }
  static constexpr double modulus(double /*trial*/, double youngs_modulus) noexcept { return youngs_modulus; }
};
struct TensionOnly {
  static constexpr const char* called = "cables";
  static constexpr double stress(double trial) noexcept { return trial > 0 ? trial : 0; }
  static constexpr double modulus(double trial, double youngs_modulus) noexcept {
    return trial >= 0 ? youngs_modulus : 0;
  }
};

/// Two-node axial element, total Lagrangian. Source: physics of a bar in Green-Lagrange strain, e.g. Bathe,
/// Finite Element Procedures, section 6.3.3; a cable is the paper's eq. (3) with one segment.
///
///     d = D + w        e = (D.w + w.w/2)/L^2  (= (l^2 - L^2)/(2 L^2))        S = E e + S_pre
///     U = A L (E e^2/2 + S_pre e)      f = dU/dw = (A S/L) d      K = df/dw = (A E/L^3) d d^T + (A S/L) I
///
/// | symbol | variable           | meaning                                            | unit |
/// |--------|--------------------|----------------------------------------------------|------|
/// | D      | reference          | from the near to the far node, reference state     | m    |
/// | w      | stretch            | displacement of the far node minus the near one's  | m    |
/// | L      | 1/inverse_length   | reference length                                   | m    |
/// | e      | strain             | Green-Lagrange strain, positive in extension       | 1    |
/// | S      | stress             | second Piola-Kirchhoff stress, positive in tension | Pa   |
/// | f      | return value       | internal force on the far node; the near one: -f   | N    |
/// | K      | return value       | the far node's block; the element's is [K -K; -K K]| N/m  |
///
/// The force N t of the textbook form is (A S l/L)(d/l) = (A S/L) d, so neither a square root nor a division
/// is needed, and a segment squeezed to nothing is as harmless as any other. Valid for any rotation and for
/// strains where E e is the material's law. A cable (TensionOnly): S < 0 -> S = 0, f = 0, K = 0 (at S = 0 the
/// side that resists counts); U stays at its minimum -A L S_pre^2/(2 E). Proven by: "the force of a bar and
/// of a cable is the derivative of its energy" (axial_test.cpp).
template <class Compression>
struct AxialElement {
  Vector3 reference;
  double inverse_length;
  AxialSection section;

  double strain(const Vector3& stretch) const noexcept {
    return (reference.dot(stretch) + 0.5 * stretch.squaredNorm()) * (inverse_length * inverse_length);
  }
  double trial_stress(double e) const noexcept { return section.youngs_modulus * e + section.prestress; }

  double energy(const Vector3& stretch) const noexcept {
    const double e = strain(stretch), E = section.youngs_modulus, S_pre = section.prestress;
    const double trial = trial_stress(e);
    const bool carries = Compression::stress(trial) == trial;
    const double density = carries ? 0.5 * E * e * e + S_pre * e : -0.5 * S_pre * S_pre / E;
    return section.area / inverse_length * density;
  }

  Vector3 force(const Vector3& stretch) const noexcept {
    const double S = Compression::stress(trial_stress(strain(stretch)));
    return (section.area * S * inverse_length) * (reference + stretch);
  }

  Matrix3 stiffness(const Vector3& stretch) const noexcept {
    const Vector3 d = reference + stretch;
    const double trial = trial_stress(strain(stretch));
    const double E = Compression::modulus(trial, section.youngs_modulus), S = Compression::stress(trial);
    const double A_over_L = section.area * inverse_length;
    return (A_over_L * inverse_length * inverse_length * E) * d * d.transpose() +
           (A_over_L * S) * Matrix3::Identity();
  }

  /// stiffness(stretch) * direction without forming the matrix.
  Vector3 stiffness_product(const Vector3& stretch, const Vector3& direction) const noexcept {
    const double trial = trial_stress(strain(stretch));
    return product(Compression::modulus(trial, section.youngs_modulus), Compression::stress(trial), stretch,
                   direction);
  }

  /// The same with the elastic modulus of a taut element even where a cable is slack: no step of the run
  /// meets anything stiffer at this strain, so it is what the step limit is computed from.
  Vector3 stiffest_product(const Vector3& stretch, const Vector3& direction) const noexcept {
    return product(section.youngs_modulus, Compression::stress(trial_stress(strain(stretch))), stretch,
                   direction);
  }

  /// The part of it that resists a change of length, as a rate's force does: none where a cable is slack. It turns
  /// with the element, so no rigid motion meets it.
  Vector3 material_product(const Vector3& stretch, const Vector3& direction) const noexcept {
    const double trial = trial_stress(strain(stretch));
    return product(Compression::modulus(trial, section.youngs_modulus), 0, stretch, direction);
  }
  Matrix3 material_stiffness(const Vector3& stretch) const noexcept {
    const Vector3 d = reference + stretch;
    const double E = Compression::modulus(trial_stress(strain(stretch)), section.youngs_modulus);
    return (section.area * inverse_length * inverse_length * inverse_length * E) * d * d.transpose();
  }

  /// Axial force N = A S l/L, positive in tension (N).
  double axial_force(const Vector3& stretch) const noexcept {
    const double S = Compression::stress(trial_stress(strain(stretch)));
    return section.area * S * inverse_length * (reference + stretch).norm();
  }

 private:
  Vector3 product(double modulus, double stress, const Vector3& stretch,
                  const Vector3& direction) const noexcept {
    const Vector3 d = reference + stretch;
    const double A_over_L = section.area * inverse_length;
    return (A_over_L * inverse_length * inverse_length * modulus * d.dot(direction)) * d +
           (A_over_L * stress) * direction;
  }
};

}  // namespace talus::fem
