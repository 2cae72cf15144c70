#include "coupler/study/reference.hpp"

#include <catch2/catch.hpp>
#include <cmath>

/// References of a model whose truth is known: 5 - 2 h^p.
namespace talus::study {
namespace {

Sample sample(double step, double order) {
  return {step, {{}, {5 - 2 * std::pow(step, order)}}};
}
std::vector<Sample> samples(double order, const std::vector<double>& finest_first = {0.1, 0.2, 0.4}) {
  std::vector<Sample> all;
  for (const double step : finest_first) all.push_back(sample(step, order));
  return all;
}
std::vector<Sample> numbers(const std::vector<double>& finest_first) {
  std::vector<Sample> all;
  for (const double number : finest_first)
    all.push_back({std::pow(2.0, static_cast<double>(all.size())), {{}, {number}}});
  return all;
}

}  // namespace

TEST_CASE("the order of three samples is that of the model they come from, also where their ratios differ") {
  for (const double order : {0.5, 1.0, 2.0, 3.7}) {
    CAPTURE(order);
    CHECK(*observed_order(samples(order)) == Approx(order).epsilon(1e-9));
    CHECK(*observed_order(samples(order, {0.05, 0.08, 0.3})) == Approx(order).epsilon(1e-9));
  }
}

TEST_CASE("samples that do not approach a limit have no order") {
  CHECK_FALSE(observed_order(numbers({1, 2, 1})));
  CHECK_FALSE(observed_order(numbers({3, 2, 1})));    // steps of one size: the next is as far
  CHECK_FALSE(observed_order(numbers({4, 2, 1.5})));  // growing
  CHECK_FALSE(observed_order(numbers({1, 2})));
}

TEST_CASE("Richardson's extrapolation removes the leading error of single numbers and histories") {
  CHECK(extrapolate(sample(0.1, 2), sample(0.3, 2), 2).numbers.front() == Approx(5).epsilon(1e-14));
  const auto value = [](double step) { return 5 - 2 * step * step; };
  const Sample fine{0.1, {{0, 1, 2}, {0, value(0.1), 2 * value(0.1)}}},
      coarse{0.2, {{0, 2}, {0, 2 * value(0.2)}}};
  const auto limit = extrapolate(fine, coarse, 2);
  CHECK(limit.numbers[1] == Approx(5).epsilon(1e-14));
  CHECK(limit.numbers[2] == Approx(10).epsilon(1e-14));
}

TEST_CASE(
    "a reference of nearly the expected order is trusted and its bar reaches the truth and the finest "
    "sample") {
  // 5 - 2 h - h^2: near order 1, but not quite, so that the extrapolation is not exact.
  const auto value = [](double h) { return 5 - 2 * h - h * h; };
  const Limit limit =
      limit_of({{0.1, {{}, {value(0.1)}}}, {0.2, {{}, {value(0.2)}}}, {0.4, {{}, {value(0.4)}}}}, 1);
  CHECK(limit.trusted);
  CHECK(*limit.order == Approx(std::log2((value(0.4) - value(0.2)) / (value(0.2) - value(0.1)))));
  CHECK(limit.low() <= value(0.1) + 1e-12);
  CHECK(limit.low() <= 5);
  CHECK(limit.high() >= 5);
}

TEST_CASE("a reference that shows another order than the expected one is not trusted and is a range") {
  const Limit limit = limit_of(samples(0.5), 2);
  CHECK_FALSE(limit.trusted);
  CHECK(limit.note == "its three values show order 0.5, not 2");
  CHECK(limit.values.numbers == samples(0.5).front().values.numbers);  // not extrapolated
  CHECK(limit.low() <= sample(0.4, 0.5).values.numbers.front() + 1e-12);
  CHECK(limit_of(samples(1.28), 1).trusted);
  CHECK_FALSE(limit_of(samples(1.32), 1).trusted);
}

TEST_CASE("values that swing, or of which one is missing, give a range and never a trusted reference") {
  const Limit swinging = limit_of(numbers({1, 1.2, 1.1}), 1);
  CHECK_FALSE(swinging.trusted);
  CHECK(swinging.note == "its three values do not approach a limit");
  CHECK(swinging.bar == Approx(0.2));
  const Limit two = limit_of({sample(0.1, 1), sample(0.2, 1)}, 1);
  CHECK_FALSE(two.trusted);
  CHECK(two.note == "fewer than three of its runs succeeded");
}

TEST_CASE("a quantity that does not depend on the step is its own limit") {
  const Limit limit = limit_of(numbers({3, 3, 3}), 1);
  CHECK(limit.trusted);
  CHECK(limit.bar == 0);
}

TEST_CASE("histories have an order, too") {
  std::vector<Sample> all;
  for (const double h : {0.1, 0.2, 0.4})
    all.push_back({h, {{0, 1, 2}, {1 + h * h, 2 - h * h, 3 + 2 * h * h}}});
  const Limit limit = limit_of(all, 2);
  CHECK(*limit.order == Approx(2).epsilon(1e-9));
  CHECK(limit.values.numbers[2] == Approx(3).epsilon(1e-13));
}

TEST_CASE("a difference is relative to the second value, or plain where that is zero") {
  CHECK(relative_difference({{}, {1.1}}, {{}, {1}}) == Approx(0.1));
  CHECK(relative_difference({{}, {0.5}}, {{}, {0}}) == 0.5);
  CHECK(relative_difference({{0, 2}, {0, 2}}, {{0, 1, 2}, {0, 1, 2}}) == 0);
  CHECK(relative_difference({{0, 1}, {3, 0}}, {{0, 1}, {0, 4}}) == Approx(5.0 / 4));
}

}  // namespace talus::study
