#include "coupler/report/report.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "core/output/result_writer.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/moving_net.hpp"

namespace talus {
namespace {

/// A result of `rows` rows and `frames` frames that its writer never finished.
void write_unfinished(const std::filesystem::path& folder, int rows, int frames, test::MovingNet& net) {
  core::ResultWriter writer({.folder = folder, .title = "A <b>net</b> </script>", .frame_capacity = frames},
                            {&net});
  for (int i = 0; i < rows; ++i) {
    net.height = i == rows / 2 ? -7 : 0;
    net.frame = i;
    writer.write_row(i);
    if (i < frames) writer.write_fields(i);
  }
}

}  // namespace

TEST_CASE("a report of a run that was killed shows what was written so far") {
  test::Folder folder("report");
  test::MovingNet net(4);
  write_unfinished(folder / "result", 10, 9, net);
  const auto data = report::report_data(folder / "result");
  CHECK(data.at("summary").at("status") == "running");
  CHECK(data.at("probes").at("curves").at(0).at("values").size() == 10);  // few rows are drawn as they are
  CHECK(data.at("energy").at("columns").at(0).size() >= 2);
  CHECK(data.at("views").at("times") ==
        nlohmann::json({0, 2, 4, 6, 8}));  // five instants, the first and the last among them
  const auto& group = data.at("views").at("groups").at(0);
  CHECK(group.at("positions").at(4).at(0) == 8);
  CHECK(group.at("cells") == nlohmann::json({0, 1, 1, 2, 2, 3}));
}

TEST_CASE("long curves are thinned and keep their last row") {
  test::Folder folder("report_long");
  test::MovingNet net(2);
  write_unfinished(folder / "result", 5000, 0, net);
  const auto data = report::report_data(folder / "result");
  const auto& curve = data.at("probes").at("curves").at(0);
  CHECK(curve.at("times").size() <= 802);
  CHECK(curve.at("times").back() == 4999);
  CHECK(data.at("energy").at("columns").at(0).back() == 4999);
  CHECK(data.at("views").at("times").empty());
}

TEST_CASE("a curve keeps its peaks however few of its rows are drawn, and so do energies that are stacked") {
  test::Folder folder("report_peak");
  test::MovingNet net(2);
  {
    core::ResultWriter writer({.folder = folder / "result"}, {&net});
    for (int i = 0; i < 5000; ++i) {
      net.height = i == 1234 ? 9 : i == 4321 ? -7 : 0.001 * (i % 7);
      net.gravity = i == 2345 ? 1e-3 : 0;
      writer.write_row(i);
    }
  }
  const auto data = report::report_data(folder / "result");
  const auto& curve = data.at("probes").at("curves").at(0);
  for (const auto& [time, value] : {std::pair{1234, 9}, std::pair{4321, -7}}) {
    const auto place = std::find(curve.at("times").begin(), curve.at("times").end(), time);
    REQUIRE(place != curve.at("times").end());
    CHECK(curve.at("values").at(static_cast<std::size_t>(place - curve.at("times").begin())) == value);
  }
  const auto& energy = data.at("energy").at("columns").at(0);
  CHECK(std::find(energy.begin(), energy.end(), 2345) != energy.end());
}

TEST_CASE("the instants that are drawn hold the one of the largest displacement") {
  test::Folder folder("report_instants");
  test::MovingNet net(4);
  {
    core::ResultWriter writer({.folder = folder / "result", .frame_capacity = 9}, {&net});
    for (int i = 0; i < 9; ++i) {
      net.frame = i == 3 ? 50 : i;
      writer.write_row(i);
      writer.write_fields(i);
    }
  }
  const auto views = report::report_data(folder / "result").at("views");
  CHECK(views.at("times") == nlohmann::json({0, 2, 3, 4, 6, 8}));
  CHECK(views.at("peak_time") == 3);
}

TEST_CASE("large groups are drawn by every so many cells, with the nodes of those only") {
  test::Folder folder("report_large");
  test::MovingNet net(50001);
  write_unfinished(folder / "result", 1, 1, net);
  const auto data = report::report_data(folder / "result");
  const auto& group = data.at("views").at("groups").at(0);
  CHECK(group.at("stride") == 5);  // 50 000 cells, 12 000 drawn at most
  CHECK(group.at("cells").size() == 2 * 10000);
  CHECK(group.at("positions").at(0).size() == 3 * 2 * 10000);
}

TEST_CASE("a title cannot break out of the page") {
  test::Folder folder("report_title");
  test::MovingNet net(2);
  write_unfinished(folder / "result", 1, 0, net);
  const std::string page = test::text_of(report::write_report(folder / "result"));
  CHECK_THAT(page, Catch::Contains("<title>A &lt;b>net&lt;/b> &lt;/script></title>"));
  CHECK_THAT(page, Catch::Contains("A <b>net<\\/b> <\\/script>"));
}

TEST_CASE("a folder without a result is an error that names it") {
  test::Folder folder("report_none");
  CHECK_THROWS_WITH(report::write_report(folder.path()),
                    "'" + folder.path().string() + "' holds no result: there is no summary.json");
}

}  // namespace talus
