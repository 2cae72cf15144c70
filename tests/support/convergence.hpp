#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>
#include <vector>

/// How fast Newton's iterations get there.
namespace talus::tests {

/// "1.2e-03 4.5e-07 ..."
inline std::string listed(const std::vector<double>& residuals) {
  std::ostringstream line;
  line.precision(2);
  line << std::scientific;
  for (const double residual : residuals) line << residual << ' ';
  return line.str();
}

/// Whether some iteration near the solution turned r into C r^2, seen as 1.7 times the digits or more; those
/// that reach round-off are not judged.
inline bool converges_quadratically(const std::vector<double>& residuals) {
  constexpr double near = 1e-2, round_off = 1e-13, digits = 1.7;
  for (std::size_t k = 0; k + 1 < residuals.size(); ++k)
    if (residuals[k] < near && residuals[k + 1] > round_off &&
        std::log(residuals[k + 1]) < digits * std::log(residuals[k]))
      return true;
  return false;
}

}  // namespace talus::tests
