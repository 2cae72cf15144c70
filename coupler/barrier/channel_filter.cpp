#include "coupler/barrier/channel_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::barrier {

namespace {

struct Coefficients {
  double b0, b1, b2, a1, a2;
};

Coefficients coefficients_of(double interval, double channel_class) {
  const double root = std::numbers::sqrt2;
  const double wd = 2 * std::numbers::pi * channel_class * 2.0775, wa = std::tan(0.5 * wd * interval);
  const double below = 1 + root * wa + wa * wa, b0 = wa * wa / below;
  return {b0, 2 * b0, b0, -2 * (wa * wa - 1) / below, (-1 + root * wa - wa * wa) / below};
}

/// From rest at the first sample's value.
void run_through(std::vector<double>& values, const Coefficients& c) {
  double x1 = values.front(), x2 = x1, y1 = x1, y2 = x1;
  for (double& value : values) {
    const double x = value, y = c.b0 * x + c.b1 * x1 + c.b2 * x2 + c.a1 * y1 + c.a2 * y2;
    x2 = x1;
    x1 = x;
    y2 = y1;
    y1 = y;
    value = y;
  }
}

}  // namespace

std::vector<double> channel_filtered(std::span<const double> samples, double interval, double channel_class) {
  std::vector<double> values(samples.begin(), samples.end());
  if (values.empty()) return values;
  const Coefficients c = coefficients_of(interval, channel_class);
  run_through(values, c);
  std::ranges::reverse(values);
  run_through(values, c);
  std::ranges::reverse(values);
  return values;
}

}  // namespace talus::barrier
