#pragma once

#include <Eigen/Core>

/// Stress and strain in the plane of a sheet, and the linear law between them. Components are those of the
/// element's material axes.
///
/// The templates take `Real` = double, or a pack of doubles that is computed side by side: the same
/// operations, the same bits.
namespace talus::fem {

/// Green-Lagrange strain in the order xx, yy, 2 xy (the shear strain counts both halves).
template <class Real>
struct PlaneStrain {
  Real xx, yy, shear;
};

/// Second Piola-Kirchhoff stress, Pa; positive in tension.
template <class Real>
struct PlaneStress {
  Real xx, yy, xy;
};

using PlaneMatrix = Eigen::Matrix3d;
using PlaneVector = Eigen::Vector3d;  ///< strain as (xx, yy, 2 xy) or stress as (xx, yy, xy)

inline PlaneVector to_vector(const PlaneStrain<double>& strain) {
  return {strain.xx, strain.yy, strain.shear};
}
inline PlaneVector to_vector(const PlaneStress<double>& stress) {
  return {stress.xx, stress.yy, stress.xy};
}
inline PlaneStrain<double> to_strain(const PlaneVector& e) {
  return {e[0], e[1], e[2]};
}

/// Work of a stress on a strain, J/m^3.
template <class Real>
Real work(const PlaneStress<Real>& stress, const PlaneStrain<Real>& strain) noexcept {
  return stress.xx * strain.xx + stress.yy * strain.yy + stress.xy * strain.shear;
}

/// Moduli of an isotropic sheet.
struct IsotropicSheet {
  double youngs_modulus = 0;  ///< Pa
  double poissons_ratio = 0;  ///< -1 < v < 1 (plane stress)
};

/// Moduli of an orthotropic sheet after Münsch and Reinhardt [P eq. 14]. `poissons_ratio_xy` is the
/// contraction along x under a pull along y: [P eq. 14] has C12 = v_xy E_x, which makes v_xy/E_y = v_yx/E_x
/// the condition of symmetry. Many programs call the other one v12.
struct OrthotropicSheet {
  double youngs_modulus_x = 0;   ///< Pa
  double youngs_modulus_y = 0;   ///< Pa
  double poissons_ratio_xy = 0;  ///< v_xy; v_yx = v_xy E_x/E_y
  double shear_modulus = 0;      ///< Pa
};

/// Linear elasticity of a sheet in plane stress, s = C e. Source: [P eq. 14], with Q = 1 - v_xy v_yx:
///
///     C = 1/Q [[E_x, v_xy E_x, 0], [v_yx E_y, E_y, 0], [0, 0, Q G]]
///     C^-1 = [[1/E_x, -v_xy/E_y, 0], [-v_xy/E_y, 1/E_y, 0], [0, 0, 1/G]]
///     w(e) = e.C e/2
///
/// Positive definite for E_x, E_y, G > 0 and v_xy^2 E_x/E_y < 1.
/// Proven by (elements_membrane.cpp): "the law of Münsch and Reinhardt is symmetric and its inverse shows the
/// contraction asked for".
struct PlaneElasticity {
  double stiffness_xx, stiffness_xy, stiffness_yy, stiffness_shear;      ///< C11, C12 = C21, C22, C33; Pa
  double compliance_xx, compliance_xy, compliance_yy, compliance_shear;  ///< S11, S12 = S21, S22, S33; 1/Pa

  /// @throws core::ConfigError unless E > 0 and -1 < v < 1
  static PlaneElasticity from(const IsotropicSheet& sheet);
  /// @throws core::ConfigError unless positive definite
  static PlaneElasticity from(const OrthotropicSheet& sheet);

  template <class Real>
  PlaneStress<Real> stress(const PlaneStrain<Real>& e) const noexcept {
    return {stiffness_xx * e.xx + stiffness_xy * e.yy, stiffness_xy * e.xx + stiffness_yy * e.yy,
            stiffness_shear * e.shear};
  }
  template <class Real>
  PlaneStrain<Real> strain(const PlaneStress<Real>& s) const noexcept {
    return {compliance_xx * s.xx + compliance_xy * s.yy, compliance_xy * s.xx + compliance_yy * s.yy,
            compliance_shear * s.xy};
  }
  double energy_density(const PlaneStrain<double>& e) const noexcept { return 0.5 * work(stress(e), e); }
  PlaneMatrix stiffness() const noexcept;
  PlaneMatrix compliance() const noexcept;
};

/// Whether a pair of Poisson's ratios obeys v_xy/E_y = v_yx/E_x within a relative 1e-6.
bool is_poisson_pair(const OrthotropicSheet& sheet, double poissons_ratio_yx);

}  // namespace talus::fem
