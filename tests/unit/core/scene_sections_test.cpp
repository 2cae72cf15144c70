#include "core/scene/sections.hpp"

#include <catch2/catch.hpp>

#include "tests/support/scenes.hpp"

namespace talus {
namespace {

using test::complaints_about;

struct Ordered {
  double low = 0, high = 0;
};
void describe(core::Fields& fields, Ordered& ordered) {
  fields.required("low", ordered.low, {.help = "lower"});
  fields.required("high", ordered.high, {.help = "upper"});
  fields.rule(ordered.low < ordered.high, "high", "must be above `low`");
}

}  // namespace

TEST_CASE("a broken rule is told at its key, but not where the values themselves could not be read") {
  CHECK(complaints_about<Ordered>("section: {low: 2, high: 1}") ==
        "scene.yaml:1:25: section.high: must be above `low`");
  CHECK(complaints_about<Ordered>("section: {low: 2, high: x}") ==
        "scene.yaml:1:25: section.high: expects a plain number, got 'x'");
}

TEST_CASE("the time section knows its end, its step and that the step fits in") {
  core::TimeScene time;
  CHECK(complaints_about("section: {end: 0.2 s, step: 50 us}", time) == "");
  CHECK(time.end == 0.2);
  CHECK(time.step == 50e-6);
  CHECK(complaints_about<core::TimeScene>("section: {end: 1 ms, step: 1 s}") ==
        "scene.yaml:1:28: section.step: must not be longer than the run, which ends at 0.001 s");
  CHECK(complaints_about<core::TimeScene>("section: {end: 0}") ==
        "scene.yaml:1:16: section.end: must be greater than 0 s, but is 0 s");
}

TEST_CASE("a probe watches a point, a part or a rock, and says so where it watches nothing or both") {
  CHECK(complaints_about<core::OutputScene>(
            "section: {probes: {p: {at: [1, 2, 3]}, q: {rock: boulder}, r: {part: rope}}}") == "");
  CHECK(complaints_about<core::OutputScene>("section: {probes: {p: {}}}") ==
        "scene.yaml:1:20: section.probes.p: needs `at`, `part` or `rock`: what is to be watched?");
  CHECK(complaints_about<core::OutputScene>("section: {probes: {p: {rock: a, part: b}}}") ==
        "scene.yaml:1:30: section.probes.p.rock: contradicts `at` and `part`, which watch the structure");
}

TEST_CASE("an unknown section of a scene is told with the known ones, and the title must be a text") {
  const auto file = core::SceneFile::parse("title: [1]\ntimes: {}\n", "scene.yaml");
  core::SceneReader reader(file);
  CHECK_THROWS_WITH(reader.finish(),
                    "scene.yaml:1:8: title: expects a text, got a list of 1\n"
                    "scene.yaml:2:1: times: unknown section; did you mean 'time'? known: title, extends, "
                    "time, structure, particles, "
                    "interface, coupling, output, regression");
}

TEST_CASE("the title of a scene is its own or the stem of its file") {
  CHECK(core::SceneFile::parse("title: A net", "net.yaml").title() == "A net");
  CHECK(core::SceneFile::parse("time: {}", "some/net.yaml").title() == "net");
}

TEST_CASE("the example scene's own sections are read as written") {
  const auto file = core::SceneFile::load(TALUS_SOURCE_DIR "/configs/examples/cable_net.yaml");
  core::SceneReader reader(file);
  const auto time = reader.required<core::TimeScene>("time");
  const auto output = reader.required<core::OutputScene>("output");
  CHECK_NOTHROW(reader.finish());
  CHECK(time.end == 0.2);
  CHECK(output.fields_every == 5e-3);
  REQUIRE(output.probes.size() == 1);
  CHECK(output.probes[0].first == "net_centre");
  CHECK(*output.probes[0].second.at == core::Vector3(1.5, 1.5, 0));
}

TEST_CASE("the schema page lists every key with its unit, range, default and meaning") {
  const auto page = core::schema_markdown("output", "what is written", [](core::Fields& fields) {
    core::OutputScene output;
    describe(fields, output);
  });
  CHECK_THAT(page, Catch::Contains("## `output`\n\nwhat is written\n"));
  CHECK_THAT(page, Catch::Contains("| `fields_every` | a time such as '50 us' | greater than 0 s | absent | "
                                   "time between frames of fields.h5"));
  CHECK_THAT(page, Catch::Contains("| `every` | a time such as '50 us' | at least 0 s | 0 |"));
  CHECK_THAT(page, Catch::Contains("## `output.probes.<name>`"));
  CHECK_THAT(page, Catch::Contains("| `at` | a list of 3, each a length such as '4 mm' |"));
}

}  // namespace talus
