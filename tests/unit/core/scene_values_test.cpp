#include <catch2/catch.hpp>

#include "tests/support/folder.hpp"
#include "tests/support/scenes.hpp"

namespace talus {
namespace {

struct Values {
  double length = 0;
  std::optional<double> ratio;
  std::optional<std::int64_t> count;
  bool flag = false;
  std::string word;
  std::filesystem::path mesh;
  std::optional<core::Vector3> point;
  std::vector<double> lengths;
  std::vector<std::int64_t> counts;
  std::vector<std::string> words;
  std::vector<core::Vector3> points;
  std::vector<std::pair<double, double>> table;
};
void describe(core::Fields& fields, Values& values) {
  fields.with_default("length", values.length, {.unit = "m", .help = "a length"});
  fields.optional("ratio", values.ratio, {.range = core::fraction, .help = "a ratio"});
  fields.optional("count", values.count, {.help = "a count"});
  fields.with_default("flag", values.flag, {.help = "a flag"});
  fields.with_default("word", values.word, {.help = "a word"});
  fields.with_default("mesh", values.mesh, {.help = "a file"});
  fields.optional("point", values.point, {.unit = "m", .help = "a point"});
  fields.with_default("lengths", values.lengths, {.unit = "m", .help = "lengths"});
  fields.with_default("counts", values.counts, {.help = "counts"});
  fields.with_default("words", values.words, {.help = "words"});
  fields.with_default("points", values.points, {.unit = "m", .help = "points"});
  fields.with_default("table", values.table, {.unit = "m, N", .help = "force over elongation"});
}

using test::complaints_about;

Values read(const std::string& inner) {
  Values values;
  REQUIRE(complaints_about("section: {" + inner + "}", values) == "");
  return values;
}
std::string error(const std::string& inner) {
  return complaints_about<Values>("section: {" + inner + "}");
}

}  // namespace

TEST_CASE("a number is taken in the SI unit of its key, or converted from the unit it names") {
  CHECK(read("length: 0.25").length == 0.25);
  CHECK(read("length: 4 mm").length == 4e-3);
  CHECK(read("length: 4mm").length == 4e-3);
  CHECK(read("length: '  -4e-1 cm '").length == -4e-3);
  CHECK(read("length: +3 ft").length == Approx(3 * 0.3048).epsilon(1e-15));
  CHECK(read("ratio: 20 %").ratio == 0.2);
}

TEST_CASE("numbers are matched in full") {
  for (const std::string text : {"1.2.3", "'1,5'", "0x10", "1_000", "--1", "1e", "1e5e5", "five", "'1 2'",
                                 "''", "1 m m 2", "4 m since 1990"})
    CHECK_THAT(error("length: " + text),
               Catch::Contains("section.length: expects a length such as '4 mm', got "));
  for (const std::string text : {"1.0", "1e3", "99999999999999999999", "1 m", "' '"})
    CHECK_THAT(error("count: " + text), Catch::Contains("section.count: expects a whole number, got "));
}

TEST_CASE("values that are not finite or that no double can hold are refused") {
  CHECK(error("length: .nan") ==
        "scene.yaml:1:19: section.length: expects a length such as '4 mm', got '.nan', which is not finite");
  CHECK(error("length: -.INF") ==
        "scene.yaml:1:19: section.length: expects a length such as '4 mm', got '-.INF', which is not finite");
  CHECK(error("length: 1e999") ==
        "scene.yaml:1:19: section.length: expects a length such as '4 mm', got '1e999', which no double can "
        "hold");
  CHECK(error("length: 1e308 km") ==
        "scene.yaml:1:19: section.length: expects a length such as '4 mm', got '1e308 km', which no double "
        "can hold");
}

TEST_CASE("a unit on a plain number is refused") {
  CHECK(error("ratio: 0.2 m") == "scene.yaml:1:18: section.ratio: expects a plain number, got '0.2 m'");
}

TEST_CASE("an angle where a number belongs is refused with its tangent") {
  CHECK(
      error("ratio: 30 deg") ==
      "scene.yaml:1:18: section.ratio: expects a plain number, got '30 deg', which is an angle; its tangent "
      "is 0.57735");
}

namespace {

struct Meant {
  double density = 0, friction = 0;
  std::vector<double> strengths;
};
constexpr core::Plausible density{.usual = {.low = 30}, .possible = {.low = 1e-3}, .hint = "g/cm^3"};
constexpr core::Plausible friction{.usual = {.high = 2}, .possible = {.high = 5}, .hint = "a tangent"};
constexpr core::Plausible strength{.possible = {.low = 1000}, .hint = "MPa, not mPa"};
void describe(core::Fields& fields, Meant& meant) {
  fields.with_default("density", meant.density, {.unit = "kg/m^3", .help = "h", .plausible = density});
  fields.with_default("friction", meant.friction, {.help = "h", .plausible = friction});
  fields.with_default("strengths", meant.strengths, {.unit = "Pa", .help = "h", .plausible = strength});
}

/// Complaints about a value, warnings marked as such.
std::string judged(const std::string& inner) {
  const auto file = core::SceneFile::parse("section: {" + inner + "}", "scene.yaml");
  std::vector<core::Complaint> complaints;
  Meant meant;
  file.read(
      "section", core::Presence::required, [&](core::Fields& fields) { describe(fields, meant); },
      complaints);
  std::string text;
  for (const auto& complaint : complaints)
    text += (complaint.warning ? "warning " : "error ") + complaint.text() + "\n";
  return text;
}

}  // namespace

TEST_CASE("a value that says what it is and cannot mean it is refused with the reason") {
  CHECK(judged("strengths: [1770 MPa, 1770 mPa]") ==
        "error scene.yaml:1:33: section.strengths[1]: '1770 mPa' is 1.77 Pa, but must be at least 1000 Pa: "
        "MPa, not mPa\n");
  CHECK(judged("friction: 30") ==
        "error scene.yaml:1:21: section.friction: is 30, but must be at most 5: a tangent\n");
  CHECK(judged("friction: -30") ==
        "error scene.yaml:1:21: section.friction: is -30, but must be at most 5: a tangent\n");
}

TEST_CASE("an unusual value, or one that another system of units explains, is read with a warning") {
  const std::string unusual = "which is unusual (usually at least 30 kg/m^3): g/cm^3\n";
  CHECK(judged("density: 2.7") == "warning scene.yaml:1:20: section.density: is 2.7 kg/m^3, " + unusual);
  CHECK(judged("density: 2.7 kg/m^3") ==
        "warning scene.yaml:1:20: section.density: '2.7 kg/m^3' is 2.7 kg/m^3, " + unusual);
  CHECK(
      judged("density: 2.7e-9") ==
      "warning scene.yaml:1:20: section.density: is 2.7e-09 kg/m^3, which is unusual (usually at least 0.001 "
      "kg/m^3): g/cm^3\n");
  CHECK(judged("friction: 3") ==
        "warning scene.yaml:1:21: section.friction: is 3, which is unusual (usually at most 2): a tangent\n");
}

TEST_CASE("nothing is said about plausible values, and zero is one") {
  CHECK(judged("density: 2.7 g/cm^3, friction: 0.6, strengths: [1 GPa, 1 kPa]").empty());
  CHECK(judged("density: 0, friction: 0, strengths: [0, 0 Pa]").empty());
}

TEST_CASE("a warning neither ends the reading of a scene nor keeps its rules from being judged") {
  Meant meant;
  CHECK(complaints_about("section: {density: 2.7}", meant).empty());
  CHECK(meant.density == 2.7);
}

TEST_CASE("words, flags, counts and lists are read") {
  const auto values =
      read("flag: true, word: chain link, count: -3, lengths: [1, 2 mm], counts: [1, 2], words: [a, b]");
  CHECK(values.flag);
  CHECK(values.word == "chain link");
  CHECK(values.count == -3);
  CHECK(values.lengths == std::vector<double>{1, 0.002});
  CHECK(values.counts == std::vector<std::int64_t>{1, 2});
  CHECK(values.words == std::vector<std::string>{"a", "b"});
  CHECK(error("flag: yes") == "scene.yaml:1:17: section.flag: expects true or false, got 'yes'");
  CHECK(error("words: a") == "scene.yaml:1:18: section.words: expects a list of values, got 'a'");
  CHECK(error("words: [[a]]") == "scene.yaml:1:19: section.words[0]: expects a word, got a list of 1");
}

TEST_CASE("points and tables convert each component and complain about each") {
  const auto values =
      read("point: [1, 2 mm, 3 cm], points: [[1, 2, 3], [4, 5, 6 mm]], table: [[1 mm, 2 kN], [2, 3]]");
  CHECK(*values.point == core::Vector3(1, 0.002, 0.03));
  CHECK(values.points.at(1) == core::Vector3(4, 5, 0.006));
  CHECK(values.table == std::vector<std::pair<double, double>>{{0.001, 2000}, {2, 3}});
  CHECK(error("point: [1, 2]") ==
        "scene.yaml:1:18: section.point: expects a list of 3 values, got a list of 2");
  CHECK(error("points: [[1, 2 s, x]]") ==
        "scene.yaml:1:24: section.points[0][1]: expects a length such as '4 mm', got '2 s'\n"
        "scene.yaml:1:29: section.points[0][2]: expects a length such as '4 mm', got 'x'");
  CHECK(error("table: [[1 N, 1 m]]") ==
        "scene.yaml:1:20: section.table[0][0]: expects a length such as '4 mm', got '1 N'\n"
        "scene.yaml:1:25: section.table[0][1]: expects a force such as '12 kN', got '1 m'");
}

TEST_CASE("an absent key keeps its default, and an absent optional value stays absent") {
  const auto values = read("");
  CHECK(values.length == 0);
  CHECK_FALSE(values.ratio);
  CHECK_FALSE(values.point);
}

TEST_CASE("a file named in a scene is found from the folder of the scene that names it, and must exist") {
  test::Folder folder("scene_values");
  folder.add("parts/rock.stl", "solid\n")
      .add("parts/base.yaml", "section: {mesh: rock.stl}\n")
      .add("scene.yaml", "extends: parts/base.yaml\n");
  const auto file = core::SceneFile::load(folder / "scene.yaml");
  core::SceneReader reader(file, {"section"});
  CHECK(reader.required<Values>("section").mesh == folder / "parts/rock.stl");
  CHECK_NOTHROW(reader.finish());
  CHECK(error("mesh: /dev/null") == "scene.yaml:1:17: section.mesh: '/dev/null' is a device, not a file");
  CHECK(error("mesh: /") == "scene.yaml:1:17: section.mesh: '/' is a folder, not a file");
  CHECK(error("mesh: nothing.stl") == "scene.yaml:1:17: section.mesh: no such file: 'nothing.stl'");
}

}  // namespace talus
