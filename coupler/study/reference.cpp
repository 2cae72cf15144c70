#include "coupler/study/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus::study {
namespace {

constexpr double lowest_order = 1e-3, highest_order = 20;

double quotient_at(double order, const std::vector<Sample>& finest_first) {
  const double fine = finest_first[0].step;
  const double h2 = std::pow(finest_first[1].step / fine, order),
               h3 = std::pow(finest_first[2].step / fine, order);
  return (h3 - h2) / (h2 - 1);
}

bool all_the_same(const std::vector<Sample>& samples) {
  return std::ranges::all_of(samples, [&](const Sample& sample) {
    return relative_difference(sample.values, samples.front().values) <= round_off;
  });
}

/// The finest sample, and the largest distance from it of all that is known.
Limit range_of(const std::vector<Sample>& finest_first, double expected_order) {
  Limit limit{.values = finest_first.front().values, .note = {}};
  for (const auto& sample : finest_first)
    limit.bar = std::max(limit.bar, relative_difference(sample.values, limit.values));
  if (finest_first.size() < 2) {
    limit.bar = 1;  // nothing is known
    return limit;
  }
  const Values further = extrapolate(finest_first[0], finest_first[1], expected_order);
  limit.bar = std::max(limit.bar, relative_difference(further, limit.values));
  return limit;
}

}  // namespace

std::optional<double> observed_order(const std::vector<Sample>& finest_first) {
  if (finest_first.size() < 3) return std::nullopt;
  const double fine_change = change(finest_first[1].values, finest_first[0].values),
               coarse_change = change(finest_first[2].values, finest_first[1].values);
  const double quotient = coarse_change / fine_change;
  if (!(quotient > quotient_at(lowest_order, finest_first))) return std::nullopt;
  double low = lowest_order, high = highest_order;
  while (high - low > 1e-12 * high) {
    const double middle = (low + high) / 2;
    if (middle <= low || middle >= high) break;
    (quotient_at(middle, finest_first) < quotient ? low : high) = middle;
  }
  return low;
}

Values extrapolate(const Sample& fine, const Sample& coarse, double order) {
  return beyond(fine.values, coarse.values, 1 / (std::pow(coarse.step / fine.step, order) - 1));
}

double Limit::reach() const {
  const double size = std::abs(values.numbers.front());
  return size > 0 ? bar * size : bar;
}

Limit limit_of(const std::vector<Sample>& finest_first, double expected_order) {
  Limit limit = range_of(finest_first, expected_order);
  if (finest_first.size() < 3) {
    limit.note = "fewer than three of its runs succeeded";
    return limit;
  }
  limit.trusted = all_the_same(finest_first);
  if (limit.trusted) return limit;
  limit.order = observed_order(finest_first);
  if (!limit.order) {
    limit.note = "its three values do not approach a limit";
    return limit;
  }
  limit.trusted = std::abs(*limit.order - expected_order) <= near_order * expected_order;
  if (!limit.trusted) {
    limit.note = fmt::format("its three values show order {:.2g}, not {:.2g}", *limit.order, expected_order);
    return limit;
  }
  limit.values = extrapolate(finest_first[0], finest_first[1], *limit.order);
  limit.bar = relative_difference(finest_first.front().values, limit.values);
  return limit;
}

}  // namespace talus::study
