#include "coupler/report/report.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "core/output/result_writer.hpp"
#include "coupler/report/instants.hpp"
#include "coupler/report/packed.hpp"
#include "coupler/report/replay.hpp"
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

/// What rocks meet where the net is: its nodes and cells, with a force on each node.
class Wires final : public core::OutputSource {
 public:
  explicit Wires(const test::MovingNet& net) : net_(net) {
    description_.groups = net.description().groups;
    description_.groups[0].name = "wires";
    description_.groups[0].fields = {{"contact_force", "N", 3, core::FieldLocation::node}};
  }
  double force = 0, apart = 0;  // N, m

  const core::OutputDescription& description() const override { return description_; }
  void fill_probes(std::span<double>) const override {}
  void fill_ledger(std::span<double>) const override {}
  void fill_positions(std::size_t group, std::span<double> positions) const override {
    net_.fill_positions(group, positions);
    for (double& place : positions) place *= 1 + apart;
  }
  void fill_field(std::size_t, std::size_t, std::span<double> values) const override {
    std::ranges::fill(values, force);
  }

 private:
  const test::MovingNet& net_;
  core::OutputDescription description_;
};

/// Numbers out of a text in base64, read independently of what wrote it.
template <class Number>
std::vector<Number> numbers(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, held = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(letters.find(c));
    if ((held += 6) >= 8) bytes += static_cast<char>(bits >> (held -= 8) & 255);
  }
  std::vector<Number> result(bytes.size() / sizeof(Number));
  std::memcpy(result.data(), bytes.data(), result.size() * sizeof(Number));
  return result;
}

/// m; the i-th coordinate of a group in a frame.
double position(const nlohmann::json& group, std::size_t frame, std::size_t i) {
  const auto steps = numbers<std::uint16_t>(group.at("positions"));
  const auto nodes = group.at("nodes").get<std::size_t>();
  return group.at("low").at(i % 3).get<double>() +
         group.at("step").at(i % 3).get<double>() * steps.at(3 * nodes * frame + i);
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
  CHECK(data.at("replay").at("times") == nlohmann::json({0, 1, 2, 3, 4, 5, 6, 7, 8}));
  const auto& group = data.at("replay").at("groups").at(0);
  CHECK(position(group, 8, 0) == Approx(8));
  CHECK(position(group, 8, 11) == Approx(8 + 11));
  CHECK(numbers<std::uint16_t>(group.at("cells")) == std::vector<std::uint16_t>{0, 1, 1, 2, 2, 3});
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
  CHECK(data.at("replay").at("times").empty());
  CHECK(data.at("replay").at("lacks") ==
        "the result has no fields.h5: its scene names no output.fields_every");
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

TEST_CASE(
    "a replay of many frames shows the first, the last and those of the largest displacement and of the "
    "first contact") {
  test::Folder folder("report_instants");
  test::MovingNet net(4);
  {
    core::ResultWriter writer({.folder = folder / "result", .frame_capacity = 1000}, {&net});
    for (int i = 0; i < 1000; ++i) {
      net.frame = i == 347 ? 5000 : i;  // what a net of that name has: displacement
      writer.write_row(i);
      writer.write_fields(i);
    }
  }
  const auto replay = report::report_data(folder / "result").at("replay");
  const auto frames = replay.at("frames").get<std::vector<std::int64_t>>();
  CHECK(frames.size() <= report::most_frames);
  CHECK(frames.size() >= report::most_frames - 4);
  CHECK(frames.front() == 0);
  CHECK(frames.back() == 999);
  CHECK(frames.at(replay.at("peak").get<std::size_t>()) == 347);
  CHECK(replay.at("contact").is_null());  // a net alone touches nothing
  CHECK(replay.at("of") == 1000);
  CHECK(replay.at("times").at(replay.at("peak").get<std::size_t>()) == 347);
}

TEST_CASE("frames are spread evenly about those that must be shown, and never more than asked for") {
  for (const std::int64_t frames : {1, 2, 5, 30, 31, 1000})
    for (const std::int64_t most : {4, 5, 29, 150}) {
      const report::Instants instants{.peak = frames / 3, .contact = frames / 7};
      const auto chosen = report::chosen_frames(frames, most, instants);
      CAPTURE(frames, most);
      CHECK(std::ssize(chosen) <= std::min(frames, most));
      CHECK(std::ranges::count(chosen, 0) == 1);
      CHECK(std::ranges::count(chosen, frames - 1) == 1);
      CHECK(std::ranges::count(chosen, frames / 3) == 1);
      CHECK(std::ranges::count(chosen, frames / 7) == 1);
      if (frames <= most) CHECK(std::ssize(chosen) == frames);
      if (frames > most) CHECK(std::ssize(chosen) >= most - 2);
    }
}

TEST_CASE("the replay of large groups keeps its budget by leaving out cells, and says which share") {
  test::Folder folder("report_large");
  test::MovingNet net(50001);
  write_unfinished(folder / "result", 30, 30, net);
  const auto replay = report::report_data(folder / "result").at("replay");
  const auto& group = replay.at("groups").at(0);
  CHECK(replay.at("frames").size() >= 24);
  CHECK(replay.at("groups").dump().size() < report::replay_budget * 1.02);
  CHECK(replay.at("groups").dump().size() > report::replay_budget / 2);
  const auto stride = group.at("stride").get<std::size_t>();
  CHECK(stride > 1);
  CHECK(numbers<std::uint16_t>(group.at("cells")).size() == 2 * ((50000 + stride - 1) / stride));
  const double step = group.at("step").at(0).get<double>();  // x of the second node:
  CHECK(position(group, replay.at("frames").size() - 1, 3) == Approx(29 + 3).margin(0.51 * step));
}

TEST_CASE("axial forces are drawn on one scale, to the 254th part of it") {
  test::Folder folder("report_colours");
  test::MovingNet net(4);
  write_unfinished(folder / "result", 9, 9, net);  // 2000 N and one more each frame
  const auto replay = report::report_data(folder / "result").at("replay");
  const auto& scale = replay.at("colours").at(0);
  const auto& group = replay.at("groups").at(0);
  CHECK(scale.at("unit") == "N");
  CHECK(group.at("colour") == 0);
  const auto values = numbers<std::uint8_t>(group.at("values"));
  REQUIRE(values.size() == 9 * 3);
  for (std::size_t frame = 0; frame < 9; ++frame)
    CHECK(scale.at("low").get<double>() + scale.at("step").get<double>() * values[3 * frame] ==
          Approx(2000.0 + static_cast<double>(frame)).margin(0.51 * scale.at("step").get<double>()));
}

TEST_CASE("one frame makes no replay, and the page's data say so") {
  test::Folder folder("report_one_frame");
  test::MovingNet net(4);
  write_unfinished(folder / "result", 1, 1, net);
  const auto replay = report::report_data(folder / "result").at("replay");
  CHECK(replay.at("lacks") == "the fields hold one frame only, which does not move");
  CHECK(replay.at("groups").size() == 1);  // for the still picture
}

TEST_CASE("wires that lie on the net are drawn once, and their contact force tells the first contact") {
  test::Folder folder("report_doubles");
  test::MovingNet net(4);
  Wires wires(net);
  {
    core::ResultWriter writer({.folder = folder / "result", .frame_capacity = 9}, {&net, &wires});
    for (int i = 0; i < 9; ++i) {
      net.frame = i;
      wires.force = i < 5 ? 0 : -3;
      writer.write_row(i);
      writer.write_fields(i);
    }
  }
  const auto replay = report::report_data(folder / "result").at("replay");
  CHECK(replay.at("doubles") == nlohmann::json({{"wires", "net"}}));
  CHECK(replay.at("groups").size() == 1);
  CHECK(replay.at("groups").at(0).at("name") == "net");
  CHECK(replay.at("contact") == 5);
}

TEST_CASE("wires apart from the net are drawn beside it") {
  test::Folder folder("report_apart");
  test::MovingNet net(4);
  Wires wires(net);
  wires.apart = 0.01;
  {
    core::ResultWriter writer({.folder = folder / "result", .frame_capacity = 2}, {&net, &wires});
    for (int i = 0; i < 2; ++i) writer.write_fields(i);
  }
  const auto replay = report::report_data(folder / "result").at("replay");
  CHECK(replay.at("doubles").empty());
  CHECK(replay.at("groups").size() == 2);
  CHECK(replay.at("contact").is_null());
}

TEST_CASE("numbers are packed as base64 of RFC 4648") {
  const auto text = [](const std::string& letters) {
    return report::base64({reinterpret_cast<const std::uint8_t*>(letters.data()), letters.size()});
  };
  CHECK(text("").empty());
  CHECK(text("f") == "Zg==");
  CHECK(text("fo") == "Zm8=");
  CHECK(text("foo") == "Zm9v");
  CHECK(text("foobar") == "Zm9vYmFy");
  CHECK(text("\xff\xfe\xfd") == "//79");
}

TEST_CASE("a damaged fields file ends a report with the error of the reader") {
  test::Folder folder("report_damaged");
  test::MovingNet net(4);
  write_unfinished(folder / "result", 3, 3, net);
  std::ofstream(folder / "result" / "fields.h5", std::ios::trunc) << "no HDF5";
  CHECK_THROWS_WITH(report::write_report(folder / "result"), Catch::Contains("fields.h5"));
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
