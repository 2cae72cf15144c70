#include "coupler/accuracy/estimate.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace talus::accuracy {

namespace {

constexpr double truth = 3;

std::vector<Sample> samples(const std::vector<double>& sizes, double factor, double order) {
  std::vector<Sample> all;
  for (const double size : sizes) all.push_back({size, truth + factor * std::pow(size, order)});
  return all;
}

}  // namespace

TEST_CASE(
    "bars contain the truth where the error is C h^p, and are no wider than the factor of safety says") {
  for (const double order : {1.0, 1.5, 2.0})
    for (const auto& sizes : {std::vector<double>{1, 2, 4}, {0.5, 1, 2}, {0.25, 0.5, 1}, {1, 1.5, 2.25}}) {
      INFO("order " << order << ", sizes from " << sizes.front());
      const Estimate found = estimate(samples(sizes, -0.1, order), {1, 2});
      REQUIRE(found.kind == Estimate::Kind::bar);
      CHECK(*found.order == Approx(order).epsilon(1e-6));
      CHECK(found.below == Approx(1.25 * 0.1).epsilon(1e-6));
      CHECK(found.above == found.below);
    }
}

TEST_CASE(
    "an order that is not the expected one gives a range that holds the truth, and says which order was "
    "seen") {
  const Estimate slow = estimate(samples({1, 2, 4}, 0.1, 0.5), {1, 2});
  REQUIRE(slow.kind == Estimate::Kind::range);
  CHECK(slow.below >= 0.1);
  CHECK(slow.note == "order 0.5 seen, 1 to 2 expected");
  const Estimate fast = estimate(samples({1, 2, 4}, 0.1, 4), {1, 2});
  REQUIRE(fast.kind == Estimate::Kind::range);
  CHECK(fast.below >= 0.1);
  CHECK(estimate(samples({1, 2, 4}, 0.1, 1), {2, 2}).kind == Estimate::Kind::range);
}

TEST_CASE("values that swing have a range with all of them in it") {
  const Estimate found = estimate({{1, 3.0}, {2, 3.2}, {4, 2.9}}, {1, 2});
  REQUIRE(found.kind == Estimate::Kind::range);
  CHECK(found.note == "the runs do not approach a limit");
  CHECK(3.0 - found.below <= 2.9);
  CHECK(3.0 + found.above >= 3.2);
}

TEST_CASE(
    "two runs give the bar of the lowest expected order, three times as wide, and say that it was not "
    "checked") {
  const Estimate coarse = estimate(samples({1, 2}, 0.1, 1), {1, 2});
  CHECK(coarse.above == Approx(0.3));
  const Estimate fine = estimate(samples({0.5, 1}, 0.1, 1), {1, 2});
  CHECK(fine.above == Approx(0.15));
  CHECK_FALSE(fine.order);
  CHECK_THAT(fine.note, Catch::Contains("not checked"));
}

TEST_CASE("changes of round-off show no order and no range") {
  const Estimate found = estimate({{1, 3.0}, {2, 3.0 + 1e-9}, {4, 3.0 - 1e-9}}, {1, 2});
  CHECK(found.kind == Estimate::Kind::bar);
  CHECK(found.above == Approx(6e-9));
}

TEST_CASE("without a companion nothing is known") {
  CHECK(estimate({{1, 3.0}}, {1, 2}).kind == Estimate::Kind::unknown);
}

TEST_CASE("a parabola's vertex is no further above its rows than they tell") {
  // 1 - (t - 0.3)^2 at -1, 0, 1: the row at 0 is 0.09 below the vertex.
  const double bound = between_rows({1 - 1.69, 1 - 0.09, 1 - 0.49});
  CHECK(bound >= 0.09);
  CHECK(bound == Approx(0.25));
  CHECK(between_rows({3, 2, 1}) == 0);
}

}  // namespace talus::accuracy
