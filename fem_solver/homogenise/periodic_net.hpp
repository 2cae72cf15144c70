#pragma once

#include <vector>

#include "core/vector3.hpp"
#include "fem_solver/elements/axial.hpp"
#include "fem_solver/materials/plane_stress.hpp"

namespace talus::fem {

/// One cell of a flat net that repeats in its plane, z = 0.
struct PeriodicNet {
  struct Wire {
    int near = 0, far = 0;    ///< nodes of the cell; `far` may be the image in a neighbouring cell
    core::Vector3 reference;  ///< m; from the near node to the far node or its image
    AxialSection section;
    double density = 0;  ///< kg/m^3
  };
  int nodes = 0;
  double area = 0;  ///< m^2
  std::vector<Wire> wires;

  double mass_per_area() const;  ///< kg/m^2
};

/// What a net of cables answers to a strain of its plane as a whole: the sheet it is, seen from afar.
///
///     F = (1 + 2 E)^(1/2)      d = F D + w_far - w_near      W(E) = 1/A min over w of sum U(d)
///     N = t S = dW/dE = F^-1 P,   P = 1/A sum f D^T           (the derivative at the minimum: w drops out)
///
/// | symbol | variable      | meaning                                              | unit  |
/// |--------|---------------|------------------------------------------------------|-------|
/// | E      | strain        | Green-Lagrange strain of the sheet, shear = 2 E_xy   | 1     |
/// | F      | -             | its stretch; any rotation with it gives the same N   | 1     |
/// | D, d   | reference     | a wire in the reference and in the present state     | m     |
/// | w      | fluctuations  | how nodes leave the uniform motion, in the plane     | m     |
/// | U, f   | AxialElement  | energy of a wire and force on its far node           | J, N  |
/// | A      | area          | of the cell                                          | m^2   |
/// | N      | return value  | second Piola-Kirchhoff stress times thickness        | N/m   |
///
/// Exact for a net of many cells under a slowly varying strain. Wires carry tension only and do not bend; the
/// net stays flat. Source: R. Hill, On constitutive macro-variables for heterogeneous solids at finite
/// strain, Proc. R. Soc. Lond. A 326 (1972). Proven by: "the membrane force of a net is the derivative of its
/// energy" (homogenise_test.cpp).
class NetResponse {
 public:
  explicit NetResponse(const PeriodicNet& net);

  /// Follows the net to a strain from where it was left.
  /// @throws core::NumericalError if the nodes find no equilibrium there
  void stretch_to(const PlaneStrain<double>& strain);
  double energy_per_area() const;  ///< J/m^2
  /// J/m^2; with the nodes elsewhere than in equilibrium. @param fluctuations as fluctuations() gives them
  double energy_per_area(const Eigen::VectorXd& fluctuations) const;
  /// How nodes leave the uniform motion: m, x and y of each node but the first, which stays.
  const Eigen::VectorXd& fluctuations() const { return fluctuations_; }
  PlaneStress<double> membrane_force() const;  ///< N/m

 private:
  using Stretch = Eigen::Matrix2d;
  core::Vector3 change(const PeriodicNet::Wire& wire, const Eigen::VectorXd& fluctuations) const;
  double energy(const Eigen::VectorXd& fluctuations) const;
  Eigen::VectorXd gradient(const Eigen::VectorXd& fluctuations) const;
  Eigen::MatrixXd hessian(const Eigen::VectorXd& fluctuations) const;

  const PeriodicNet& net_;
  Stretch stretch_ = Stretch::Identity();
  Eigen::VectorXd fluctuations_;  ///< m; x and y of each node but the first, which stays
};

}  // namespace talus::fem
