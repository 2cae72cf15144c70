#include "coupler/report/report.hpp"

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
  CHECK(data.at("probes").at("columns").at(0).size() == 10);
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
  const auto& times = data.at("probes").at("columns").at(0);
  CHECK(times.size() <= 801);
  CHECK(times.back() == 4999);
  CHECK(data.at("views").at("times").empty());
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
