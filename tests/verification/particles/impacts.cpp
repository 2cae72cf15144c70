#include "bench/impacts/impacts.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace talus::bench;

TEST_CASE("The eight impacts of Chung and Ooi agree with theory") {
  const std::vector<ImpactResult> rows = run_impacts();
  for (int test = 1; test <= 8; ++test) {
    const auto of_test = std::ranges::count(rows, test, &ImpactResult::test);
    CHECK(of_test >= 6);
  }
  for (const ImpactResult& row : rows) {
    CAPTURE(row.test, row.situation, row.quantity, row.computed, row.expected, row.error());
    CHECK(row.passes());
  }
}
