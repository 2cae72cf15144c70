#pragma once

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
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

/// Whether the iteration ends as Newton's does: from the last residual above `near` on, none is more than
/// `constant` times the square of the one before, but for round-off. A linear rate q fails at the first residual
/// below q/constant. Not judged where no residual falls between `judged` and `near`: then nothing was seen.
inline bool converges_quadratically(const std::vector<double>& residuals) {
  constexpr double near = 1e-2, judged = 1e-6, constant = 100, round_off = 1e-12;
  std::size_t first = residuals.size();
  while (first > 0 && residuals[first - 1] < near) --first;
  bool seen = false;
  for (std::size_t k = first; k + 1 < residuals.size(); ++k) {
    if (!(residuals[k + 1] <= std::max(constant * residuals[k] * residuals[k], round_off))) return false;
    seen = seen || residuals[k] > judged;
  }
  return seen;
}

}  // namespace talus::tests
