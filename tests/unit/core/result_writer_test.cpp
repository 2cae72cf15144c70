#include "core/output/result_writer.hpp"

#include <hdf5.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "core/errors.hpp"
#include "core/output/field_reader.hpp"
#include "core/output/table.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/moving_net.hpp"

namespace talus {
namespace {

using core::ResultWriter;
using core::RunStatus;
using test::Folder;
using test::MovingNet;
using test::text_of;

ResultWriter::Options options(const Folder& folder, std::int64_t frames = 0) {
  return {.folder = folder / "result",
          .title = "A net",
          .program = "test 1",
          .scene = "net.yaml",
          .scene_hash = "0123",
          .frame_capacity = frames};
}
nlohmann::json summary_of(const Folder& folder) {
  return nlohmann::json::parse(text_of(folder / "result/summary.json"));
}

std::vector<double> numbers(const std::filesystem::path& file, const char* dataset) {
  const hid_t h5 = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t data = H5Dopen2(h5, dataset, H5P_DEFAULT);
  const hid_t space = H5Dget_space(data);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space), H5Dclose(data), H5Fclose(h5);
  return values;
}

}  // namespace

TEST_CASE("probe and energy rows of all sources stand side by side under their names") {
  Folder folder("rows");
  MovingNet net(5, "net"), rock(2, "rock");
  ResultWriter writer(options(folder), {&net, &rock});
  rock.height = 0.1;
  writer.write_row(0);
  net.height = -1.5;
  writer.write_row(0.25);
  CHECK(text_of(folder / "result/probes.csv") ==
        "time_s,net.height_m,net.speed_m_per_s,rock.height_m,rock.speed_m_per_s\n0,0,0,0.1,0\n0.25,-1.5,0,0."
        "1,0\n");
  CHECK_THAT(text_of(folder / "result/energy.csv"),
             Catch::StartsWith("time_s,net.kinetic_J,net.damping_J,net.gravity_J,rock.kinetic_J,rock.damping_"
                               "J,rock.gravity_J,error_J,error_relative\n"));
}

TEST_CASE("numbers in the tables read back as the same doubles") {
  Folder folder("digits");
  MovingNet net;
  ResultWriter writer(options(folder), {&net});
  net.height = 0.1 + 0.2;
  writer.write_row(1.0 / 3);
  std::istringstream rows(text_of(folder / "result/probes.csv"));
  std::string header;
  double time = 0, height = 0;
  char comma = 0;
  std::getline(rows, header);
  rows >> time >> comma >> height;
  CHECK(time == 1.0 / 3);
  CHECK(height == 0.1 + 0.2);
}

TEST_CASE(
    "the energy error is stored plus dissipated minus supplied against the first row, over what was on the "
    "move so far: kinetic or supplied, whichever is more") {
  using core::LedgerKind;
  core::LedgerBalance balance({{"a.kinetic_J", LedgerKind::stored},
                               {"a.elastic_J", LedgerKind::stored},
                               {"a.damping_J", LedgerKind::dissipated},
                               {"a.gravity_J", LedgerKind::supplied}});
  CHECK(balance.add(std::vector<double>{0, 7, 0, 0}).error_relative == 0);
  CHECK(balance.add(std::vector<double>{10, 7, 1, 11}).error == 0);  // 10 + 1 J came from gravity
  const auto row = balance.add(std::vector<double>{4, 12, 3, 11});   // 4 + 12 + 3 - 11 - 7 = 1 J too much
  CHECK(row.error == 1);
  CHECK(row.error_relative == 1.0 / 11);
  balance.add(std::vector<double>{40, 11, 3, 47});
  CHECK(balance.last().error == 0);
  CHECK(balance.largest().error == 1);
  CHECK(balance.largest().error_relative == 1.0 / 47);  // of the whole run, whatever was known at the time
}

TEST_CASE("the summary says running until the end, then how the run ended, with peaks and their times") {
  Folder folder("summary");
  MovingNet net;
  ResultWriter writer(options(folder), {&net});
  CHECK(summary_of(folder)["status"] == "running");
  for (const double height : {0.0, -2.0, 1.0}) {
    net.height = height;
    net.frame += 1;
    writer.write_row(net.frame);
  }
  writer.summary()["limits"] = {{"bars", 1e-4}};
  writer.finish(RunStatus::interrupted, "Ctrl-C");
  const auto summary = summary_of(folder);
  CHECK(summary["status"] == "interrupted");
  CHECK(summary["message"] == "Ctrl-C");
  CHECK(summary["title"] == "A net");
  CHECK(summary["scene_hash"] == "0123");
  CHECK(summary["limits"]["bars"] == 1e-4);
  CHECK(summary["peaks"]["net.height_m"]["value"] == -2.0);
  CHECK(summary["peaks"]["net.height_m"]["time_s"] == 2.0);
  CHECK(summary["last"]["net.height_m"] == 1.0);
  CHECK(summary["simulated_time_s"] == 2.0);
  CHECK(summary["rows"] == 3);
  CHECK(summary["energy"]["error_relative"] == 0.0);
  CHECK(summary["real_time_factor"].get<double>() == Approx(2.0 / summary["wall_time_s"].get<double>()));
}

TEST_CASE("a value that is not finite never reaches a file") {
  Folder folder("finite");
  MovingNet net;
  ResultWriter writer(options(folder, 3), {&net});
  writer.write_row(0);
  const std::string before = text_of(folder / "result/probes.csv");
  net.height = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(
      writer.write_row(0.5),
      "a result is not finite at time 0.5 s: net.height_m = nan; the last good output is at 0 s");
  CHECK(text_of(folder / "result/probes.csv") == before);
  net.frame = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(writer.write_fields(0.5), core::NumericalError);
  CHECK(numbers(folder / "result/fields.h5", "frames_written") == std::vector<double>{0});
}

TEST_CASE("rows must go forward in time and columns must differ") {
  Folder folder("misuse");
  MovingNet net, same;
  CHECK_THROWS_AS(ResultWriter(options(folder), {&net, &same}), core::UsageError);
  auto again = options(folder);
  again.existing = core::ResultFolder::Existing::replace;
  ResultWriter writer(again, {&net});
  writer.write_row(1);
  CHECK_THROWS_AS(writer.write_row(1), core::UsageError);
  CHECK_THROWS_AS(writer.write_fields(1), core::UsageError);
}

TEST_CASE("an earlier result is refused, or replaced without touching files that are not its own") {
  Folder folder("existing");
  MovingNet net;
  { ResultWriter(options(folder), {&net}).write_row(0); }
  folder.add("result/notes.txt", "mine");
  auto again = options(folder);
  CHECK_THROWS_WITH(
      ResultWriter(again, {&net}),
      "'" + again.folder.string() +
          "' is not empty; --overwrite replaces an earlier result, --out chooses another folder");
  again.existing = core::ResultFolder::Existing::replace;
  { ResultWriter writer(again, {&net}); }
  CHECK(text_of(folder / "result/notes.txt") == "mine");
  CHECK(text_of(folder / "result/probes.csv") == "time_s,net.height_m,net.speed_m_per_s\n");
  folder.add("file", "");
  again.folder = folder / "file";
  CHECK_THROWS_AS(ResultWriter(again, {&net}), core::ConfigError);
}

TEST_CASE("two runs cannot write to the same folder at the same time") {
  Folder folder("locked");
  MovingNet net;
  auto shared = options(folder);
  const ResultWriter first(shared, {&net});
  shared.existing = core::ResultFolder::Existing::replace;
  CHECK_THROWS_WITH(ResultWriter(shared, {&net}), "another run is writing to '" + shared.folder.string() +
                                                      "'; choose another folder with --out");
}

TEST_CASE("frames hold what the sources gave, and fewer frames than reserved are no error") {
  Folder folder("frames");
  MovingNet net(4);
  ResultWriter writer(options(folder, 3), {&net});
  writer.write_fields(0);
  net.frame = 1;
  writer.write_fields(0.5);
  writer.finish(RunStatus::finished);
  const auto file = folder / "result/fields.h5";
  CHECK(numbers(file, "frames_written") == std::vector<double>{2});
  CHECK(numbers(file, "time") == std::vector<double>{0, 0.5, 0});
  CHECK(numbers(file, "net/cells") == std::vector<double>{0, 1, 1, 2, 2, 3});
  for (std::size_t i = 0; i < 12; ++i) {
    CHECK(numbers(file, "net/position/000000").at(i) == static_cast<double>(i));
    CHECK(numbers(file, "net/position/000001").at(i) == 1 + static_cast<double>(i));
    CHECK(numbers(file, "net/position/000002").at(i) == 0);
  }
  CHECK(numbers(file, "net/axial_force/000001") == std::vector<double>{2001, 2001, 2001});
  pugi::xml_document xdmf;
  REQUIRE(xdmf.load_file((folder / "result/fields.xdmf").c_str()));
  CHECK(xdmf.select_nodes("//Time").size() == 2);
}

TEST_CASE("tables and fields read back what was written, without a row that a kill cut short") {
  Folder folder("read_back");
  MovingNet net(4), other(3, "other");
  {
    ResultWriter writer(options(folder, 3), {&net, &other});
    net.height = 0.1;
    writer.write_row(0.5);
    net.frame = 2;
    writer.write_fields(0.5);
  }
  std::ofstream(folder / "result/probes.csv", std::ios::app) << "1,2";
  const auto table = core::read_table(folder / "result/probes.csv");
  CHECK(table.rows() == 1);
  CHECK(table.column("net.height_m")->front() == 0.1);
  CHECK(table.column("nothing") == nullptr);

  const core::FieldReader fields(folder / "result/fields.h5");
  CHECK(fields.times() == std::vector<double>{0.5});
  REQUIRE(fields.groups().size() == 2);
  const auto& group = fields.groups().front();
  CHECK(group.name == "net");
  CHECK(group.kind == core::CellKind::segment);
  CHECK(group.nodes == 4);
  CHECK(group.cells == std::vector<std::int64_t>{0, 1, 1, 2, 2, 3});
  REQUIRE(group.fields.size() == 2);
  CHECK(group.fields[0].name == "axial_force");
  CHECK(group.fields[0].unit == "N");
  CHECK(group.fields[0].location == core::FieldLocation::cell);
  CHECK(group.fields[1].components == 3);
  CHECK(fields.read(group, "position", 0).at(11) == 2 + 11);
  CHECK(fields.read(group, "axial_force", 0) == std::vector<double>{2002, 2002, 2002});
}

TEST_CASE("a table that is missing or holds no numbers is an error that names it") {
  Folder folder("tables");
  folder.add("words.csv", "a,b\n1,two\n").add("uneven.csv", "a,b\n1\n");
  CHECK_THROWS_WITH(core::read_table(folder / "none.csv"),
                    "there is no table " + (folder / "none.csv").string());
  CHECK_THROWS_WITH(core::read_table(folder / "words.csv"),
                    "'two' in " + (folder / "words.csv").string() + " is no number");
  CHECK_THROWS_WITH(core::read_table(folder / "uneven.csv"),
                    (folder / "uneven.csv").string() + " has a row of 1 cells under 2 names");
}

TEST_CASE("more frames than reserved are refused") {
  Folder folder("capacity");
  MovingNet net;
  ResultWriter writer(options(folder, 1), {&net});
  writer.write_fields(0);
  CHECK_THROWS_AS(writer.write_fields(1), core::UsageError);
}

TEST_CASE("frames that were not written take no place on the disk") {
  Folder folder("sparse");
  MovingNet net(1000);
  ResultWriter writer(options(folder, 1000), {&net});
  writer.write_fields(0);
  struct stat status {};
  REQUIRE(::stat((folder / "result/fields.h5").c_str(), &status) == 0);
  const double frame = 8.0 * (3 * 1000 + 3 * 1000 + 999), cells = 8.0 * 2 * 999;
  CHECK(static_cast<double>(status.st_size) > 1000 * frame);
  const double tables = 1000 * 3 * 2000;  // the library's own, for each of a frame's three datasets
  CHECK(512.0 * static_cast<double>(status.st_blocks) < frame + cells + tables);
}

}  // namespace talus
