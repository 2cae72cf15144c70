#include "coupler/accuracy/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupler/study/reference.hpp"

namespace talus::accuracy {
namespace {

study::Sample as_study(const Sample& sample) {
  return {.step = sample.size, .values = {{}, {sample.value}}};
}

double limit(const Sample& fine, const Sample& coarse, double order) {
  return study::extrapolate(as_study(fine), as_study(coarse), order).numbers.front();
}

std::optional<double> order_of(const std::vector<Sample>& finest_first) {
  if (finest_first.size() < 3) return std::nullopt;
  return study::observed_order(
      {as_study(finest_first[0]), as_study(finest_first[1]), as_study(finest_first[2])});
}

double value_of_the_run(const std::vector<Sample>& samples) {
  return std::ranges::find(samples, 1.0, &Sample::size)->value;
}

Estimate bar(double half_width, std::optional<double> order, std::string note = {}) {
  return {Estimate::Kind::bar, half_width, half_width, order, std::move(note)};
}

/// All values, and the finest with three times the last change on both sides.
Estimate range(const std::vector<Sample>& finest_first, std::optional<double> order, std::string note) {
  const double own = value_of_the_run(finest_first), finest = finest_first.front().value;
  const double reach = safety_without_order * std::abs(finest_first[1].value - finest);
  double low = finest - reach, high = finest + reach;
  for (const auto& sample : finest_first) {
    low = std::min(low, sample.value);
    high = std::max(high, sample.value);
  }
  return {Estimate::Kind::range, own - low, high - own, order, std::move(note)};
}

double largest_change(const std::vector<Sample>& samples) {
  const auto [least, most] = std::ranges::minmax(samples, {}, &Sample::value);
  return most.value - least.value;
}

}  // namespace

bool Orders::fits(double order) const {
  return order >= (1 - study::near_order) * low && order <= (1 + study::near_order) * high;
}

std::string Orders::text() const {
  return low == high ? fmt::format("{:.2g}", low) : fmt::format("{:.2g} to {:.2g}", low, high);
}

Estimate estimate(std::vector<Sample> samples, const Orders& expected) {
  std::ranges::sort(samples, {}, &Sample::size);
  const double own = value_of_the_run(samples);
  if (samples.size() < 2) return {.note = "no companion succeeded"};
  const double change = largest_change(samples);
  if (change <= unresolved * std::abs(own)) return bar(safety_without_order * change, {});
  if (samples.size() == 2) {
    const double error = std::abs(own - limit(samples[0], samples[1], expected.low));
    const double share = samples[0].size < 1 ? safety_without_order / 2 : safety_without_order;
    return bar(share * error, {}, "two runs only: the order was not checked");
  }
  if (samples.size() > 3) samples.resize(3);
  const auto order = order_of(samples);
  if (!order) return range(samples, {}, "the runs do not approach a limit");
  if (!expected.fits(*order))
    return range(samples, order, fmt::format("order {:.2g} seen, {} expected", *order, expected.text()));
  return bar(safety * std::abs(own - limit(samples[0], samples[1], std::min(*order, expected.high))), order);
}

double between_rows(const std::vector<double>& values) {
  if (values.size() < 3) return 0;
  const auto largest = std::ranges::max_element(values, {}, [](double v) { return std::abs(v); });
  if (largest == values.begin() || largest + 1 == values.end()) return 0;
  return std::abs(largest[-1] - 2 * largest[0] + largest[1]) / 8;
}

}  // namespace talus::accuracy
