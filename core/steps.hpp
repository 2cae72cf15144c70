#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

/// How a span of time is cut into steps: the one rule of every program, for steps of a window and for steps or
/// windows of a run.
namespace talus::core {

/// A ratio of two times of a scene that is this close to a whole number is one: 0.2 s is 4000 times 50 us.
inline constexpr double whole_ratio = 1e-9;

/// The fewest equal steps, none longer than `longest`, that cover `span` (both in s).
/// @pre span > 0, longest > 0
inline std::int64_t steps_in(double span, double longest) noexcept {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(span / longest * (1 - whole_ratio))));
}

struct EqualSteps {
  std::int64_t count = 1;
  double length =
      0;  ///< s; as named where that divides the span, else shorter, so that the last one ends there
};
inline EqualSteps equal_steps(double span, double longest) noexcept {
  const std::int64_t count = steps_in(span, longest);
  const double whole = static_cast<double>(count) * longest;
  const bool divides = std::abs(whole - span) <= 2 * whole_ratio * span;
  return {count, divides ? longest : span / static_cast<double>(count)};
}

/// A sentence for a run whose end (s) is no multiple of the step or window that its scene names (s); else empty.
/// @param what "step", "window"
std::string words_about_length(const char* what, double end, double named);

}  // namespace talus::core
