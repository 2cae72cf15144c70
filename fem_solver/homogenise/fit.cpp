#include "fem_solver/homogenise/fit.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "core/errors.hpp"

namespace talus::fem {

namespace {

/// What a membrane that stands for a mechanism gets of stiffness, as a part of the net's: an impact at a
/// tenth of the span's sag strains the mechanism by tenths, so that a hundredth would already be felt.
constexpr double least_share = 1e-3;
constexpr int steps = 5;

struct Sample {
  PlaneStrain<double> strain;
  PlaneStress<double> stress;  ///< Pa
};

std::vector<Sample> pull_and_shear(const PeriodicNet& net, const FitOptions& options) {
  // Strains along x and y and the shear, in shares of the step's strain.
  constexpr std::array<std::array<double, 3>, 7> paths{
      {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0.5, 0}, {0.5, 1, 0}, {1, 1, 1}, {1, 1, -1}}};
  std::vector<Sample> samples;
  for (const auto& [x, y, shear] : paths) {
    NetResponse response(net);
    for (int step = 1; step <= steps; ++step) {
      const double share = options.strain * step / steps;
      const PlaneStrain<double> strain{x * share, y * share, shear * share};
      response.stretch_to(strain);
      const auto force = response.membrane_force();
      samples.push_back(
          {strain,
           {force.xx / options.thickness, force.yy / options.thickness, force.xy / options.thickness}});
    }
  }
  return samples;
}

/// C11, C12, C22, C33.
struct Stiffness {
  double xx = 0, xy = 0, yy = 0, shear = 0;
};

Stiffness least_squares(const std::vector<Sample>& samples, const PlaneStress<double>& prestress) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double shear_squared = 0, shear_stress = 0;
  for (const auto& [e, s] : samples) {
    const Eigen::Vector3d row_x(e.xx, e.yy, 0), row_y(0, e.xx, e.yy);
    normal += row_x * row_x.transpose() + row_y * row_y.transpose();
    right += row_x * (s.xx - prestress.xx) + row_y * (s.yy - prestress.yy);
    shear_squared += e.shear * e.shear;
    shear_stress += e.shear * s.xy;
  }
  const Eigen::Vector3d fitted = normal.ldlt().solve(right);
  return {fitted[0], fitted[1], fitted[2], shear_stress / shear_squared};
}

void make_positive_definite(Stiffness& stiffness, std::vector<std::string>& remarks) {
  const double scale = std::sqrt(stiffness.xx * stiffness.yy);
  const double most_coupling = std::sqrt(1 - least_share);
  if (stiffness.xy > most_coupling * scale) {
    remarks.push_back(
        fmt::format("the net is a mechanism: C12 is {:.5g} of sqrt(C11 C22) and was reduced to {:.5g} of it",
                    stiffness.xy / scale, most_coupling));
    stiffness.xy = most_coupling * scale;
  }
  if (stiffness.shear < least_share * scale) {
    remarks.push_back(
        fmt::format("the net hardly resists shear: G was raised from {:.3g} to {:.3g} of sqrt(C11 C22)",
                    stiffness.shear / scale, least_share));
    stiffness.shear = least_share * scale;
  }
}

double relative_error(const std::vector<Sample>& samples, const Stiffness& stiffness,
                      const PlaneStress<double>& prestress) {
  double missed = 0, carried = 0;
  for (const auto& [e, s] : samples) {
    missed += std::pow(s.xx - prestress.xx - stiffness.xx * e.xx - stiffness.xy * e.yy, 2) +
              std::pow(s.yy - prestress.yy - stiffness.xy * e.xx - stiffness.yy * e.yy, 2) +
              std::pow(s.xy - prestress.xy - stiffness.shear * e.shear, 2);
    carried += s.xx * s.xx + s.yy * s.yy + s.xy * s.xy;
  }
  return std::sqrt(missed / carried);
}

}  // namespace

HomogenisedSheet fit_sheet(const PeriodicNet& net, const FitOptions& options) {
  const double t = options.thickness;
  NetResponse unstretched(net);
  unstretched.stretch_to({0, 0, 0});
  const auto force = unstretched.membrane_force();
  HomogenisedSheet sheet{.moduli = {},
                         .prestress = {force.xx / t, force.yy / t, force.xy / t},
                         .thickness = t,
                         .density = net.mass_per_area() / t,
                         .error = 0,
                         .remarks = {}};
  const auto samples = pull_and_shear(net, options);
  Stiffness stiffness = least_squares(samples, sheet.prestress);
  if (stiffness.xx <= 0 || stiffness.yy <= 0)
    throw core::ConfigError(
        fmt::format("up to a strain of {:g} the net carries nothing along {}: fit it at a larger strain",
                    options.strain, stiffness.xx <= 0 ? "x" : "y"));
  make_positive_definite(stiffness, sheet.remarks);
  const double coupling = stiffness.xy * stiffness.xy / (stiffness.xx * stiffness.yy);
  sheet.moduli = {.youngs_modulus_x = stiffness.xx * (1 - coupling),
                  .youngs_modulus_y = stiffness.yy * (1 - coupling),
                  .poissons_ratio_xy = stiffness.xy / stiffness.xx,
                  .shear_modulus = stiffness.shear};
  sheet.error = relative_error(samples, stiffness, sheet.prestress);
  return sheet;
}

}  // namespace talus::fem
