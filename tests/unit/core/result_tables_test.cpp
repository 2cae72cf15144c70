#include "core/output/result_tables.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "core/output/result_writer.hpp"
#include "tests/support/folder.hpp"

namespace talus {
namespace {

using core::TableKind;
using test::Folder;
using test::text_of;

/// Events that the test adds, and a distribution of two rows.
class Counter final : public core::OutputSource {
 public:
  explicit Counter(const std::string& name = "gate") {
    description_.tables = {{name, {"time_s", "size_m"}, 10, TableKind::events},
                           {name + ".sizes", {"from_m", "count"}, 2, TableKind::distribution}};
  }
  std::vector<std::pair<double, double>> events;
  double small = 0, large = 0;

  const core::OutputDescription& description() const override { return description_; }
  void fill_probes(std::span<double>) const override {}
  void fill_ledger(std::span<double>) const override {}
  void fill_positions(std::size_t, std::span<double>) const override {}
  void fill_field(std::size_t, std::size_t, std::span<double>) const override {}
  std::int64_t table_rows(std::size_t table) const override {
    return table == 0 ? static_cast<std::int64_t>(events.size()) : 2;
  }
  void fill_table(std::size_t table, std::int64_t first, std::span<double> values) const override {
    std::vector<double> all{0.01, small, 0.1, large};
    if (table == 0) all.clear();
    for (std::size_t k = static_cast<std::size_t>(first); table == 0 && k < events.size(); ++k)
      all.insert(all.end(), {events[k].first, events[k].second});
    REQUIRE(values.size() == all.size());
    std::ranges::copy(all, values.begin());
  }

 private:
  core::OutputDescription description_;
};

core::ResultWriter::Options written_to(const Folder& folder) {
  return {.folder = folder / "result", .existing = core::ResultFolder::Existing::replace};
}

}  // namespace

TEST_CASE("events are in their file as soon as they are told, each once") {
  const Folder folder("events");
  Counter counter;
  core::ResultWriter writer(written_to(folder), {&counter});
  CHECK(text_of(folder / "result/gate.csv") == "time_s,size_m\n");
  counter.events = {{0.25, 0.5}};
  writer.write_row(1);
  CHECK(text_of(folder / "result/gate.csv") == "time_s,size_m\n0.25,0.5\n");
  writer.write_row(2);
  counter.events.emplace_back(2.5, 0.125);
  writer.write_row(3);
  CHECK(text_of(folder / "result/gate.csv") == "time_s,size_m\n0.25,0.5\n2.5,0.125\n");
}

TEST_CASE("the summary names the file of events and holds the distribution of the last row") {
  const Folder folder("distribution");
  Counter counter;
  core::ResultWriter writer(written_to(folder), {&counter});
  counter.events = {{0.25, 0.5}};
  counter.small = 7;
  writer.write_row(1);
  counter.small = 3;
  counter.large = 4;
  writer.write_row(2);
  writer.finish(core::RunStatus::finished);
  const auto tables = nlohmann::json::parse(text_of(folder / "result/summary.json"))["tables"];
  CHECK(tables["gate"] == nlohmann::json{{"file", "gate.csv"}, {"rows", 1}});
  CHECK(tables["gate.sizes"] == nlohmann::json::parse(R"([{"from_m": 0.01, "count": 3.0},
                                                          {"from_m": 0.1, "count": 4.0}])"));
}

TEST_CASE("replacing a result removes the files of its tables and nothing else") {
  const Folder folder("replaced_tables");
  const Counter counter("before"), other("after");
  core::ResultWriter(written_to(folder), {&counter}).finish(core::RunStatus::finished);
  std::ofstream(folder / "result/mine.csv") << "x\n";
  core::ResultWriter(written_to(folder), {&other}).finish(core::RunStatus::finished);
  CHECK_FALSE(std::filesystem::exists(folder / "result/before.csv"));
  CHECK(std::filesystem::exists(folder / "result/after.csv"));
  CHECK(std::filesystem::exists(folder / "result/mine.csv"));
}

TEST_CASE("a table's file is never one that another table or every result has") {
  const Folder folder("table_names");
  const Counter twice, again, probes("probes");
  CHECK_THROWS_AS(core::ResultTables(folder.path(), {&twice, &again}), core::UsageError);
  CHECK_THROWS_AS(core::ResultTables(folder.path(), {&probes}), core::UsageError);
}

TEST_CASE("a value of a table that is not finite ends the run") {
  const Folder folder("table_nan");
  Counter counter;
  core::ResultWriter writer(written_to(folder), {&counter});
  counter.events = {{1, std::numeric_limits<double>::quiet_NaN()}};
  CHECK_THROWS_AS(writer.write_row(1), core::NumericalError);
  CHECK(text_of(folder / "result/gate.csv") == "time_s,size_m\n");
}

}  // namespace talus
