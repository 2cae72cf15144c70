#include "coupler/study/ranking.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace talus::study {
namespace {

using nlohmann::json;

Point exact_point(const char* method, double error, double seconds) {
  return {method, Interval::exactly(error), Interval::exactly(seconds)};
}
Point timed(const char* method, const Interval& seconds) {
  return {method, Interval::exactly(1e-6), seconds};
}
/// Who is fastest to 10 %.
json fastest(const std::vector<Point>& points) {
  return rankings(points).at("fastest_to").at(0);
}

}  // namespace

TEST_CASE("a point is on the Pareto front unless another is as good in both and better in one") {
  const std::vector<Point> points{exact_point("a", 0.1, 1),   exact_point("a", 0.01, 2),
                                  exact_point("b", 0.1, 2),   exact_point("b", 0.02, 3),
                                  exact_point("b", 0.001, 9), exact_point("c", 0.1, 1)};
  CHECK(pareto_front(points) == std::vector<bool>{true, true, false, false, true, true});
}

TEST_CASE("a method wins only where its slowest run is faster than the fastest of all others") {
  const auto clear = fastest(
      {timed("a", {.value = 1, .low = 0.9, .high = 1.1}), timed("b", {.value = 1.3, .low = 1.2, .high = 2})});
  CHECK(clear.at("winner") == "a");
  CHECK(clear.at("tied").empty());
  const auto tie = fastest({timed("a", {.value = 1, .low = 0.9, .high = 1.25}),
                            timed("b", {.value = 1.3, .low = 1.2, .high = 2}),
                            timed("c", {.value = 3, .low = 2.9, .high = 3.1})});
  CHECK(tie.at("winner").is_null());
  CHECK(tie.at("tied") == json({"a", "b"}));
}

TEST_CASE("a method that was timed once wins against no other") {
  const auto row = fastest({timed("a", {.value = 1, .low = 1, .high = 1, .known = false}),
                            timed("b", {.value = 9, .low = 8, .high = 10})});
  CHECK(row.at("winner").is_null());
  CHECK(row.at("methods").at("a").at("high").is_null());
  CHECK(fastest({timed("a", {.value = 1, .low = 1, .high = 1, .known = false})}).at("winner") ==
        "a");  // there is no other
}

TEST_CASE("a point reaches a wanted error only where its whole bar does") {
  const Point point{"a", {.value = 0.09, .low = 0.07, .high = 0.11}, Interval::exactly(1)};
  CHECK(fastest({point}).at("winner").is_null());
  CHECK(rankings({point}).at("most_exact_within").at(1).at("methods").at("a").at("value") == 0.09);
}

TEST_CASE("errors whose bars overlap are tied") {
  const Point a{"a", {.value = 0.01, .low = 0, .high = 0.03}, Interval::exactly(0.5)};
  const Point b{"b", {.value = 0.02, .low = 0, .high = 0.04}, Interval::exactly(0.5)};
  const Point c{"c", {.value = 0.2, .low = 0.18, .high = 0.22}, Interval::exactly(0.5)};
  const auto row = rankings({a, b, c}).at("most_exact_within").at(1);
  CHECK(row.at("winner").is_null());
  CHECK(row.at("tied") == json({"a", "b"}));
}

}  // namespace talus::study
