#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "core/vector3.hpp"
#include "fem_solver/materials/plane_stress.hpp"

/// Energy, force, stiffness and mass of the constant-strain membrane triangle.
namespace talus::fem {

using core::Vector3;
using Matrix3 = Eigen::Matrix3d;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

template <class Real>
struct Triple {
  Real x, y, z;
};
template <class Real>
Triple<Real> sum(const Triple<Real>& a, const Triple<Real>& b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
Real dot(const Triple<Real>& a, const Triple<Real>& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Total Lagrangian triangle of constant strain in plane stress. Source: [P section 4.2, eq. 2]; Zienkiewicz
/// and Taylor, The Finite Element Method, vol. 2. Written in displacements: at rest the strain is exactly
/// zero.
///
///     h_k = sum_i g_ik w_i    a_k = A_k + h_k       k = 1, 2;  i = nodes 1, 2;  w_i = u_i - u_0
///     e_xx = A_1.h_1 + h_1.h_1/2     e_yy = A_2.h_2 + h_2.h_2/2     2 e_xy = A_1.h_2 + A_2.h_1 + h_1.h_2
///     U = V w(e)
///     f_i = dU/du_i = V (g_i1 (s_xx a_1 + s_xy a_2) + g_i2 (s_yy a_2 + s_xy a_1))      f_0 = -f_1 - f_2
///     K_ij = V (B_i^T C B_j + (g_i.s g_j) I)         C = ds/de
///     B_i = [g_i1 a_1^T; g_i2 a_2^T; g_i1 a_2^T + g_i2 a_1^T]      g_0 = -g_1 - g_2
///
/// | symbol | variable  | meaning                                                                   | unit  |
/// |--------|-----------|---------------------------------------------------------------------------|-------|
/// | A_k    | axes      | unit material axes in the reference plane, perpendicular to each other    | 1     |
/// | g_i    | gradient  | derivative of node i's shape function along the material axes             | 1/m   |
/// | V      | volume    | reference area times thickness                                            | m^3   |
/// | u_i    |           | displacement of node i                                                    | m     |
/// | e, s   |           | Green-Lagrange strain, second Piola-Kirchhoff stress, in material axes    | 1, Pa |
/// | f_i    | force     | internal force: the node must be held with it                             | N     |
///
/// Valid for any rotation and for the strains of the law. A triangle turned inside out is not detected.
/// Proven by (elements_membrane.cpp): "the force of a membrane is the derivative of its energy and its
/// stiffness that of its force".
template <class Real>
struct MembraneTriangle {
  std::array<Triple<Real>, 2> axes;
  std::array<std::array<Real, 2>, 2> gradient;  ///< [node 1 or 2][axis]
  Real volume;

  /// Current tangent vectors a_1, a_2 and the strain they mean.
  struct Deformation {
    std::array<Triple<Real>, 2> tangents;
    PlaneStrain<Real> strain;
  };

  /// @param displacements of nodes 1 and 2 less node 0's, m
  Deformation deform(const std::array<Triple<Real>, 2>& displacements) const noexcept {
    const Triple<Real> h1 = displacement_gradient(displacements, 0),
                       h2 = displacement_gradient(displacements, 1);
    const auto& [A1, A2] = axes;
    return {{Triple<Real>{A1.x + h1.x, A1.y + h1.y, A1.z + h1.z},
             Triple<Real>{A2.x + h2.x, A2.y + h2.y, A2.z + h2.z}},
            {dot(A1, h1) + 0.5 * dot(h1, h1), dot(A2, h2) + 0.5 * dot(h2, h2),
             dot(A1, h2) + dot(A2, h1) + dot(h1, h2)}};
  }

  /// Internal forces of nodes 1 and 2; node 0 has minus their sum.
  std::array<Triple<Real>, 2> force(const Deformation& deformation,
                                    const PlaneStress<Real>& s) const noexcept {
    const auto& [a1, a2] = deformation.tangents;
    const Real xx = volume * s.xx, yy = volume * s.yy, xy = volume * s.xy;
    // tractions on the faces across the material axes
    const Triple<Real> t1 = combine({xx, xy}, a1, a2), t2 = combine({xy, yy}, a1, a2);
    return {combine(gradient[0], t1, t2), combine(gradient[1], t1, t2)};
  }

  /// Rate of the strain.
  PlaneStrain<Real> strain_rate(const Deformation& deformation,
                                const std::array<Triple<Real>, 2>& velocities) const noexcept {
    const Triple<Real> h1 = displacement_gradient(velocities, 0), h2 = displacement_gradient(velocities, 1);
    const auto& [a1, a2] = deformation.tangents;
    return {dot(a1, h1), dot(a2, h2), dot(a1, h2) + dot(a2, h1)};
  }

  /// Changes of `force` along changes of the displacements, without forming K.
  std::array<Triple<Real>, 2> force_change(const Deformation& deformation, const PlaneStress<Real>& s,
                                           const PlaneMatrix& moduli,
                                           const std::array<Triple<Real>, 2>& changes) const noexcept {
    const Triple<Real> h1 = displacement_gradient(changes, 0), h2 = displacement_gradient(changes, 1);
    const auto& [a1, a2] = deformation.tangents;
    const PlaneVector strain_change(dot(a1, h1), dot(a2, h2), dot(a1, h2) + dot(a2, h1));
    const PlaneVector stress_change = moduli * strain_change;
    const auto by_stress = force(deformation, {stress_change[0], stress_change[1], stress_change[2]});
    const auto by_turning = force({{h1, h2}, {}}, s);
    return {sum(by_stress[0], by_turning[0]), sum(by_stress[1], by_turning[1])};
  }

 private:
  static Triple<Real> combine(const std::array<Real, 2>& g, const Triple<Real>& p,
                              const Triple<Real>& q) noexcept {
    return {g[0] * p.x + g[1] * q.x, g[0] * p.y + g[1] * q.y, g[0] * p.z + g[1] * q.z};
  }
  Triple<Real> displacement_gradient(const std::array<Triple<Real>, 2>& w, std::size_t axis) const noexcept {
    return combine({gradient[0][axis], gradient[1][axis]}, w[0], w[1]);
  }
};

/// The reference state of a triangle as its nodes give it.
struct MembranePatch {
  std::array<Vector3, 3> nodes;  ///< m
  double thickness = 0;          ///< m
  /// Direction whose projection on the triangle is the first material axis; without one the first edge is.
  std::optional<Vector3> material_axis;
};

/// @throws core::ConfigError where the triangle has no area, or the axis stands within 0.01 degrees of its
/// normal
MembraneTriangle<double> membrane_triangle(const MembranePatch& patch);

/// d2U/du2 as 3x3 blocks of nodes 0, 1, 2.
/// @param tangent ds/de at the deformation's strain, Pa
Matrix9 membrane_stiffness(const MembraneTriangle<double>& triangle,
                           const MembraneTriangle<double>::Deformation& deformation,
                           const PlaneStress<double>& stress, const PlaneMatrix& tangent) noexcept;

/// Lumped mass of each of the three nodes, kg: a third of density x volume.
inline double membrane_node_mass(double volume, double density) noexcept {
  return density * volume / 3;
}

}  // namespace talus::fem
