#include "dem_solver/boundary/closest_point.hpp"

#include <algorithm>

namespace talus::dem {

Weights closest_on_segment(const Triple<double>& p, const Triple<double>& a,
                           const Triple<double>& b) noexcept {
  const Triple<double> ab = b - a;
  const double t = std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0);
  return {1 - t, t, 0};
}

namespace {
/// Twice the signed areas that p's projection spans with the opposite edges are the weights inside; outside,
/// the closest edge's or vertex's region decides. The projections of p on the edges are the only quantities
/// needed.
struct EdgeProjections {
  double ab_from_a, ac_from_a, ab_from_b, ac_from_b, ab_from_c, ac_from_c;
};
}  // namespace

Weights closest_on_triangle(const Triple<double>& p, const Triple<double>& a, const Triple<double>& b,
                            const Triple<double>& c) noexcept {
  const Triple<double> ab = b - a, ac = c - a;
  const EdgeProjections d{dot(ab, p - a), dot(ac, p - a), dot(ab, p - b),
                          dot(ac, p - b), dot(ab, p - c), dot(ac, p - c)};
  if (d.ab_from_a <= 0 && d.ac_from_a <= 0) return {1, 0, 0};
  if (d.ab_from_b >= 0 && d.ac_from_b <= d.ab_from_b) return {0, 1, 0};
  if (d.ac_from_c >= 0 && d.ab_from_c <= d.ac_from_c) return {0, 0, 1};

  const double over_c = d.ab_from_a * d.ac_from_b - d.ab_from_b * d.ac_from_a;
  if (over_c <= 0 && d.ab_from_a >= 0 && d.ab_from_b <= 0) {
    const double t = d.ab_from_a / (d.ab_from_a - d.ab_from_b);
    return {1 - t, t, 0};
  }
  const double over_b = d.ab_from_c * d.ac_from_a - d.ab_from_a * d.ac_from_c;
  if (over_b <= 0 && d.ac_from_a >= 0 && d.ac_from_c <= 0) {
    const double t = d.ac_from_a / (d.ac_from_a - d.ac_from_c);
    return {1 - t, 0, t};
  }
  const double over_a = d.ab_from_b * d.ac_from_c - d.ab_from_c * d.ac_from_b;
  const double towards_c = d.ac_from_b - d.ab_from_b, towards_b = d.ab_from_c - d.ac_from_c;
  if (over_a <= 0 && towards_c >= 0 && towards_b >= 0) {
    const double t = towards_c / (towards_c + towards_b);
    return {0, 1 - t, t};
  }
  const double sum = over_a + over_b + over_c;
  const double wb = over_b / sum, wc = over_c / sum;
  return {1 - wb - wc, wb, wc};
}

}  // namespace talus::dem
