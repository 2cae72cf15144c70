#pragma once

#include <string>
#include <vector>

#include "fem_solver/homogenise/periodic_net.hpp"

namespace talus::fem {

struct FitOptions {
  double strain = 0;     ///< largest Green-Lagrange strain the sheet is fitted at
  double thickness = 0;  ///< m; of the sheet; any, since only products with it count
};

/// The membrane that stands for a net.
struct HomogenisedSheet {
  OrthotropicSheet moduli;        ///< Pa
  PlaneStress<double> prestress;  ///< Pa, second Piola-Kirchhoff
  double thickness = 0;           ///< m
  double density = 0;             ///< kg/m^3
  double error = 0;  ///< root mean square of the stress it misses, relative to that of the net's stress
  std::vector<std::string> remarks;  ///< where the law of a membrane cannot follow the net
};

/// Pulls the net along each axis with the other held, along both at once and in two proportions between, and
/// shears it while it is pulled along both (so that its wires stay taut), in five steps up to the strain
/// each. The moduli are the least-squares fit of
///     S_xx = S0_xx + C11 e_xx + C12 e_yy    S_yy = S0_yy + C12 e_xx + C22 e_yy    S_xy = C33 shear
///     E_x = C11 (1 - C12^2/(C11 C22)),  E_y = C22 (1 - C12^2/(C11 C22)),  v_xy = C12/C11,  G = C33
/// to the stresses, in the notation of OrthotropicSheet. Held edges are what net panels are tested with (ISO
/// 17746). A net of cables can be a mechanism, which no positive definite law is: then C12 is held below
/// sqrt(0.999 C11 C22), which leaves a thousandth of C11 and C22 as E_x and E_y, and G above a thousandth of
/// sqrt(C11 C22), and a remark says so.
/// @throws core::ConfigError if the net carries nothing along an axis up to this strain
HomogenisedSheet fit_sheet(const PeriodicNet& net, const FitOptions& options);

}  // namespace talus::fem
