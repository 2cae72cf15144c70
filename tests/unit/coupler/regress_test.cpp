#include <catch2/catch.hpp>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "coupler/regress/compare.hpp"
#include "coupler/regress/outcome.hpp"
#include "coupler/regress/pool.hpp"
#include "coupler/regress/report.hpp"
#include "tests/support/folder.hpp"

using namespace talus;
using namespace talus::coupler::regress;

namespace {

const Table baseline{.columns = {"time_s", "net.force_x_N", "net.force_y_N", "stone.height_m"},
                     .rows = {{0, 0, 0, 1}, {0.1, 1e-12, 200, 0.5}, {0.2, 2e-12, 100, 0.25}}};

Table changed(std::size_t row, std::size_t column, double by) {
  Table table = baseline;
  table.rows[row][column] += by;
  return table;
}

nlohmann::json summary(const char* version = "0.1.0") {
  return {
      {"status", "finished"},
      {"rows", 3},
      {"frames", 0},
      {"wall_time_s", 1.5},
      {"iterations", {{"windows", 210}, {"windows_not_converged", 0}, {"windows_halved", 2}, {"mean", 1.5}}},
      {"participants",
       {{"structure", std::string("fem_solver ") + version}, {"particles", "springs (NumPy)"}}}};
}

/// Runs a shell script in the place of talus, which gets `run SCENE --out FOLDER ...`.
FinishedRun run_script(const test::Folder& folder, const std::string& script, double time_limit) {
  std::ofstream(folder / "talus") << "#!/bin/sh\n" << script;
  std::filesystem::permissions(folder / "talus", std::filesystem::perms::owner_all);
  const ScheduledRun run{.scene = folder / "scene.yaml",
                         .folder = folder / "result",
                         .console = folder / "console.txt",
                         .time_limit = time_limit};
  return run_side_by_side({run}, 1, folder / "talus")->front();
}

}  // namespace

TEST_CASE("what is counted of a summary is there, and another status, row, window or participant is told") {
  const auto baseline = counts_of(summary());
  CHECK(baseline.at("/rows") == 3);
  CHECK(baseline.at("/iterations/windows") == 210);
  CHECK(first_other_count(baseline, counts_of(summary())).empty());
  for (const auto& [pointer, value] : {std::pair<const char*, nlohmann::json>{"/status", "failed"},
                                       {"/rows", 4},
                                       {"/frames", 1},
                                       {"/iterations/windows", 209},
                                       {"/iterations/windows_not_converged", 1},
                                       {"/iterations/windows_halved", 3},
                                       {"/participants/structure", "other_solver 1.0"}}) {
    auto other = summary();
    other[nlohmann::json::json_pointer(pointer)] = value;
    CAPTURE(pointer);
    CHECK_FALSE(first_other_count(baseline, counts_of(other)).empty());
  }
  auto weak = summary();
  weak.erase("iterations");
  CHECK(first_other_count(baseline, counts_of(weak)) == "/iterations/windows is gone");
  CHECK(first_other_count(counts_of(weak), baseline) == "/iterations/windows is new, 210");
}

TEST_CASE("the next version of a program breaks no baseline, another program does") {
  CHECK(first_other_count(counts_of(summary("0.1.0")), counts_of(summary("0.2.0-rc1"))).empty());
  CHECK(counts_of(summary()).at("/participants").at("structure") == "fem_solver");
  CHECK(counts_of(summary()).at("/participants").at("particles") == "springs (NumPy)");
}

TEST_CASE("a baseline with a key that nobody compares, and a summary without one that all have, are errors") {
  auto baseline = counts_of(summary());
  baseline["/nonconverged_windows"] = 0;
  CHECK_THAT(first_other_count(baseline, counts_of(summary())),
             Catch::Contains("the baseline has /nonconverged_windows, which is not compared"));
  auto without = summary();
  without.erase("rows");
  CHECK_THROWS_WITH(counts_of(without), "summary.json has no /rows");
}

TEST_CASE("a run is ended at its time limit, counts as failed, and says so") {
  const test::Folder folder("regress_time");
  const auto finished = run_script(folder, "echo step 7; exec sleep 100\n", 0.3);
  CHECK(finished.too_slow);
  CHECK(finished.seconds < 60);
  const Regression regression{.name = "slow", .scene = {}, .baseline = folder / "baseline", .tolerances = {}};
  const ScheduledRun run{
      .scene = {}, .folder = folder / "result", .console = folder / "console.txt", .time_limit = 0.3};
  const Outcome outcome = judge(regression, run, finished);
  CHECK(outcome.verdict == Verdict::failed);
  CHECK_THAT(outcome.message, Catch::Contains("time limit of 0.3 s") && Catch::Contains("step 7"));
  CHECK_FALSE(run_script(folder, "exit 0\n", 30).too_slow);
}

TEST_CASE("a result equals its baseline up to the tolerance of each column, and no farther") {
  const RegressionScene tolerances{.relative = 1e-3, .absolute = 0, .columns = {}};
  CHECK(compare(baseline, baseline, tolerances).same());
  CHECK(compare(baseline, changed(2, 3, 0.99e-3), tolerances).same());
  CHECK_FALSE(compare(baseline, changed(2, 3, 1.01e-3), tolerances).same());
}

TEST_CASE("the round-off of one component is measured against the whole vector") {
  const RegressionScene tolerances{.relative = 1e-6, .absolute = 0, .columns = {}};
  CHECK(compare(baseline, changed(1, 1, 1e-12), tolerances).same());
  CHECK_FALSE(compare(baseline, changed(1, 1, 3e-4), tolerances).same());
}

TEST_CASE("the first differing time and field are named, and the worst column of all") {
  Table result = changed(1, 3, 1e-3);
  result.rows[2][2] += 50;
  const auto comparison = compare(baseline, result, {.relative = 1e-6, .absolute = 0, .columns = {}});
  REQUIRE(comparison.first);
  CHECK(comparison.first->column == "stone.height_m");
  CHECK(comparison.first->time == 0.1);
  CHECK(text(*comparison.first) ==
        "stone.height_m differs first at 0.1 s: expected 0.5, found 0.501, allowed 1e-06");
  CHECK(comparison.worst_column == "net.force_y_N");
  CHECK(comparison.worst == Approx(50 / (1e-6 * 200)));
}

TEST_CASE("columns may have a tolerance of their own") {
  const RegressionScene tolerances{
      .relative = 1e-9, .absolute = 0, .columns = {{.contains = "height", .relative = 0.1}}};
  CHECK(compare(baseline, changed(2, 3, 0.09), tolerances).same());
  CHECK_FALSE(compare(baseline, changed(2, 2, 0.09), tolerances).same());
}

TEST_CASE("a value that is not finite equals nothing, not even with a wide tolerance") {
  const RegressionScene wide{.relative = 1e9, .absolute = 0, .columns = {}};
  CHECK_FALSE(compare(baseline, changed(1, 3, std::numeric_limits<double>::quiet_NaN()), wide).same());
  CHECK_FALSE(compare(baseline, changed(1, 3, std::numeric_limits<double>::infinity()), wide).same());
}

TEST_CASE("new, lost and reordered columns and another number of rows are told apart") {
  const auto mismatch = [](const Table& result) { return compare(baseline, result, {}).mismatch; };
  Table more = baseline, less = baseline, other = baseline, shorter = baseline;
  more.columns.push_back("x");
  less.columns.pop_back();
  std::swap(other.columns[1], other.columns[2]);
  shorter.rows.pop_back();
  CHECK(mismatch(more) == "the column x is new");
  CHECK(mismatch(less) == "the column stone.height_m is gone");
  CHECK(mismatch(other) == "the columns stand in another order");
  CHECK(mismatch(shorter) == "2 rows instead of 3");
}

TEST_CASE("a table that is missing, ragged or holds a word is refused with file and line") {
  test::Folder folder("regress_table");
  folder.add("good.csv", "time_s,a\n0,1\n0.5,-2e-3\n")
      .add("ragged.csv", "a,b\n1,2\n3\n")
      .add("word.csv", "a\nx\n");
  const Table good = read_table(folder / "good.csv");
  CHECK(good.columns == std::vector<std::string>{"time_s", "a"});
  CHECK(good.rows == std::vector<std::vector<double>>{{0, 1}, {0.5, -2e-3}});
  using Catch::Contains;
  CHECK_THROWS_WITH(read_table(folder / "none.csv"), Contains("none.csv: is missing or empty"));
  CHECK_THROWS_WITH(read_table(folder / "ragged.csv"), Contains("ragged.csv:3: has 1 values"));
  CHECK_THROWS_WITH(read_table(folder / "word.csv"), Contains("word.csv:2: expects a number, got 'x'"));
}

TEST_CASE("a folder without regressions and a wrong tolerance are errors of the user's") {
  test::Folder folder("regress_scenes");
  CHECK_THROWS_AS(find_regressions(folder.path()), core::ConfigError);
  folder.add("b.yaml", "regression: {relative: 1e-3}").add("a.yaml", "regression: {}").add("notes.txt", "");
  const auto found = find_regressions(folder.path());
  REQUIRE(found.size() == 2);
  CHECK(found[0].name == "a");
  CHECK(found[1].tolerances.relative == 1e-3);
  CHECK(found[1].baseline == folder / "baselines/b");
  folder.add("c.yaml", "regression: {relative: -1}");
  CHECK_THROWS_WITH(find_regressions(folder.path()), Catch::Contains("regression.relative"));
}

TEST_CASE("the JUnit report counts a failure for each regression that differs or fails") {
  test::Folder folder("regress_junit");
  Outcome same, different;
  same.name = "a";
  different.name = "b";
  different.verdict = Verdict::different;
  different.message = "1 < 2 & so on";
  write_junit({same, different}, folder / "junit.xml");
  const std::string xml = test::text_of(folder / "junit.xml");
  using Catch::Contains;
  CHECK_THAT(xml, Contains(R"(tests="2" failures="1")"));
  CHECK_THAT(xml, Contains(R"(<testcase classname="regression" name="a" time="0" />)"));
  CHECK_THAT(xml, Contains(R"(message="1 &lt; 2 &amp; so on")"));
  CHECK_THAT(table_of({same, different}), Contains("2 regressions, 1 bad"));
}
