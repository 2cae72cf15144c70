#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "coupler/study/study_scene.hpp"

namespace talus::study {

/// What a quantity is in one run: a single number, or a history with its times.
struct Values {
  std::vector<double> times;  ///< s; empty for a single number
  std::vector<double> numbers;
};

/// Reads a quantity from a result folder. @throws ConfigError where the result has no such column or number
Values read_values(const Quantity& quantity, const std::filesystem::path& result);

/// Richardson's extrapolation to a step of zero (L. F. Richardson, Phil. Trans. R. Soc. A 210, 1911):
///
///     q0 = q_h + (q_h - q_rh) / (r^p - 1)
///
/// | symbol | meaning                                       |
/// |--------|-----------------------------------------------|
/// | q_h    | value at the finer step h                     |
/// | q_rh   | value at the coarser step r h, r > 1          |
/// | p      | order of convergence                          |
///
/// Test: "Richardson's extrapolation removes the leading error of single numbers and histories".
/// Valid where the error is c h^p to leading order. Histories are extrapolated at each time of the finer run.
struct Refinement {
  double ratio = 2;  ///< r
  double order = 2;  ///< p
};
Values extrapolate(const Values& fine, const Values& coarse, const Refinement& refinement);

/// The order of convergence that three single numbers at steps h, r h, r^2 h show: log((q2 - q1) / (q1 - q0))
/// / log r. Nothing where they do not approach a limit steadily.
std::optional<double> observed_order(const std::vector<double>& finest_first, double ratio);

/// |a - b| / |b| of single numbers, and of histories the root mean square of the difference over that of b,
/// at the times of b. Where b is zero: the difference itself.
double relative_difference(const Values& a, const Values& b);

}  // namespace talus::study
