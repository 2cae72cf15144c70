#include "fem_solver/materials/plane_stress.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/errors.hpp"

namespace talus::fem {
namespace {

void require_positive(const char* name, double modulus) {
  if (!(modulus > 0) || !std::isfinite(modulus))
    throw core::ConfigError(
        fmt::format("{} of a membrane must be greater than 0 Pa, but is {} Pa", name, modulus));
}

/// C and S of [P eq. 14] for a sheet whose moduli are checked.
PlaneElasticity munsch_reinhardt(const OrthotropicSheet& sheet) {
  const double Ex = sheet.youngs_modulus_x, Ey = sheet.youngs_modulus_y, vxy = sheet.poissons_ratio_xy;
  const double vyx = vxy * Ex / Ey;
  const double Q = 1 - vxy * vyx;
  return {.stiffness_xx = Ex / Q,
          .stiffness_xy = vxy * Ex / Q,
          .stiffness_yy = Ey / Q,
          .stiffness_shear = sheet.shear_modulus,
          .compliance_xx = 1 / Ex,
          .compliance_xy = -vxy / Ey,
          .compliance_yy = 1 / Ey,
          .compliance_shear = 1 / sheet.shear_modulus};
}

PlaneMatrix orthotropic_matrix(double xx, double xy, double yy, double shear) {
  PlaneMatrix matrix;
  matrix << xx, xy, 0, xy, yy, 0, 0, 0, shear;
  return matrix;
}

}  // namespace

PlaneElasticity PlaneElasticity::from(const IsotropicSheet& sheet) {
  const double E = sheet.youngs_modulus, v = sheet.poissons_ratio;
  require_positive("youngs_modulus", E);
  if (!(v > -1 && v < 1))
    throw core::ConfigError(
        fmt::format("poissons_ratio of a membrane must lie between -1 and 1, but is {}", v));
  return munsch_reinhardt({E, E, v, E / (2 * (1 + v))});
}

PlaneElasticity PlaneElasticity::from(const OrthotropicSheet& sheet) {
  require_positive("youngs_modulus_x", sheet.youngs_modulus_x);
  require_positive("youngs_modulus_y", sheet.youngs_modulus_y);
  require_positive("shear_modulus", sheet.shear_modulus);
  const double vxy = sheet.poissons_ratio_xy,
               limit = std::sqrt(sheet.youngs_modulus_y / sheet.youngs_modulus_x);
  if (!(std::abs(vxy) < limit))
    throw core::ConfigError(
        fmt::format("poissons_ratio_xy of a membrane must be smaller than sqrt(E_y/E_x) = {:.6g} in "
                    "magnitude, but is {}: "
                    "the stiffness would not be positive definite",
                    limit, vxy));
  return munsch_reinhardt(sheet);
}

PlaneMatrix PlaneElasticity::stiffness() const noexcept {
  return orthotropic_matrix(stiffness_xx, stiffness_xy, stiffness_yy, stiffness_shear);
}

PlaneMatrix PlaneElasticity::compliance() const noexcept {
  return orthotropic_matrix(compliance_xx, compliance_xy, compliance_yy, compliance_shear);
}

bool is_poisson_pair(const OrthotropicSheet& sheet, double poissons_ratio_yx) {
  const double left = sheet.poissons_ratio_xy / sheet.youngs_modulus_y;
  const double right = poissons_ratio_yx / sheet.youngs_modulus_x;
  return std::abs(left - right) <= 1e-6 * std::max(std::abs(left), std::abs(right));
}

}  // namespace talus::fem
