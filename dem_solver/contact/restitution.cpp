#include "dem_solver/contact/restitution.hpp"

#include <cmath>

namespace talus::dem {

double oscillator_restitution(double damping_ratio) noexcept {
  const double z = damping_ratio;
  const double s = 1 - z * z;
  if (std::abs(s) < 1e-9) return std::exp(-2 * z);  // the common limit of both branches
  const double leaving_time = s > 0 ? 2 * std::acos(z) / std::sqrt(s) : 2 * std::acosh(z) / std::sqrt(-s);
  return std::exp(-z * leaving_time);
}

double oscillator_damping_ratio(double restitution) noexcept {
  if (restitution >= 1) return 0;
  double low = 0, high = 1;
  while (oscillator_restitution(high) > restitution) high *= 2;
  // Halving down to neighbouring numbers; the function falls strictly.
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
    (oscillator_restitution(middle) > restitution ? low : high) = middle;
  return high;
}

double hertz_damping_ratio(double restitution) noexcept {
  return std::sqrt(5.0 / 6.0) * oscillator_damping_ratio(restitution);
}

}  // namespace talus::dem
