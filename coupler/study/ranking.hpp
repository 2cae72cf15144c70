#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

/// Who is fastest and who most exact, told no more sharply than it was measured.
namespace talus::study {

/// A measured value and between what it lies.
struct Interval {
  double value = 0, low = 0, high = 0;
  bool known = true;  ///< false: measured once, nobody knows how far it may be off; it wins against no other
  /// A value without doubt.
  static Interval exactly(double v) { return {v, v, v, true}; }
};
nlohmann::json to_json(const Interval& interval);

/// A point with its error and its cost.
struct Point {
  std::string method;
  Interval error;
  Interval seconds;  ///< wall time of the time loop: median, least and most of the repetitions
};

/// For each point, whether no other is both at least as exact and at least as fast (and better in one), by its values.
std::vector<bool> pareto_front(const std::vector<Point>& points);

/// For each wanted error, each method's least time among its points whose error, at its highest, is not above; for
/// each budget, each method's least error among its points that take no longer. A method wins where its interval lies
/// below those of all others; else those that reach it are tied.
///
///     {"fastest_to": [{"error": 0.1, "methods": {name: interval}, "winner": name or null, "tied": [names]}],
///      "most_exact_within": [{"seconds": 1, ...}]}
nlohmann::json rankings(const std::vector<Point>& points);

}  // namespace talus::study
