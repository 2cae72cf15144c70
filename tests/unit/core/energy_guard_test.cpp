#include "core/output/energy_guard.hpp"

#include <catch2/catch.hpp>

#include "core/errors.hpp"

using namespace talus::core;
using Catch::Matchers::Contains;

namespace {

/// A ledger of a rock and a dashpot, and who watches it.
struct Watched {
  LedgerBalance balance{{{"kinetic_J", LedgerKind::stored},
                         {"damping_J", LedgerKind::dissipated},
                         {"gravity_J", LedgerKind::supplied}}};
  EnergyGuard guard{EnergyErrorScene{}, balance};
  double time = 0;
  std::vector<std::string> row(double kinetic, double damping, double gravity = 0) {
    balance.add(std::vector<double>{kinetic, damping, gravity});
    return guard.look(time += 1);
  }
};

}  // namespace

TEST_CASE("a balance that is off by more than 2 % of the impact is warned of once") {
  Watched run;
  CHECK(run.row(1000, 0).empty());
  CHECK(run.row(1019, 0).empty());
  const auto warnings = run.row(1021, 0);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("off by 21 J") && Contains("2.06 %"));
  CHECK(run.row(1030, 0).empty());
}

TEST_CASE(
    "a run that stays off by more than a fifth of its impact ends, one that is off for a moment does not") {
  Watched lost, recovers;
  const auto go_wrong = [](Watched& run, int rows) {
    run.row(1000, 0);
    for (int n = 0; n < rows; ++n) run.row(700, 0);
  };
  CHECK_THROWS_WITH(go_wrong(lost, 21), Contains("off by 30 %"));
  CHECK_NOTHROW(go_wrong(recovers, 20));
}

TEST_CASE("no run ends as finished that was off by more than a fifth of all that was on the move") {
  Watched run, first_row;
  run.row(1000, 0);
  run.row(700, 0);
  run.row(1000, 0);
  CHECK_THROWS_AS(run.guard.judge(3), NumericalError);
  first_row.row(1, 0);
  first_row.row(3, 0);          // twice the energy that was there by then
  first_row.row(1002, 0, 999);  // but little of what is to come
  CHECK_NOTHROW(first_row.guard.judge(3));
}

TEST_CASE("what is dissipated may not come back: a line that falls is named with what it lost") {
  Watched run;
  run.row(1000, 0);
  CHECK(run.row(900, 100).empty());
  CHECK(run.row(915, 85).empty());  // 1.5 % of the impact
  const auto warnings = run.row(950, 50);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("damping_J has fallen by 50 J"));
  CHECK(run.row(1000, 0).empty());
}
