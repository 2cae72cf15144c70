#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>

#include "core/scene/tree.hpp"
#include "core/utf8.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/scenes.hpp"

namespace talus {
namespace {

struct Cable {
  double area = 0;
  double density = 0;
  std::optional<double> prestress;
};
void describe(core::Fields& fields, Cable& cable) {
  fields.required("area", cable.area, {.unit = "m^2", .range = core::positive, .help = "cross-section"});
  fields.required("density", cable.density, {.unit = "kg/m^3", .range = core::positive, .help = "density"});
  fields.optional("prestress", cable.prestress, {.unit = "Pa", .help = "prestress"});
}

enum class Side { left, right };
struct Net {
  std::int64_t cells = 1;
  Side side = Side::left;
  std::vector<std::pair<std::string, Cable>> parts;
  std::vector<Cable> ropes;
};
void describe(core::Fields& fields, Net& net) {
  fields.with_default("cells", net.cells, {.range = {.low = 1, .high = 100}, .help = "cells a side"});
  fields.choice("side", net.side, {"left", "right"}, "where it hangs");
  fields.map("parts", net.parts, "parts");
  fields.list("ropes", net.ropes, "ropes", 1);
}

using test::complaints_about;

std::string text_error(const std::string& text) {
  try {
    core::SceneFile::parse(text, "scene.yaml");
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("an unknown key is named with its place and the keys that are known") {
  CHECK(complaints_about<Cable>("section:\n  area: 1\n  density: 2\n  colour: red\n") ==
        "scene.yaml:4:3: section.colour: unknown key; known here: area, density, prestress");
}

TEST_CASE("a mistyped key is named with the nearest known key") {
  CHECK(complaints_about<Cable>("section: {area: 1, density: 2, presstres: 1}") ==
        "scene.yaml:1:32: section.presstres: unknown key; did you mean 'prestress'? known here: area, "
        "density, prestress");
}

TEST_CASE("a duplicate key is an error although yaml-cpp itself takes it silently") {
  CHECK(complaints_about<Cable>("section:\n  area: 1\n  density: 2\n  area: 3\n") ==
        "scene.yaml:4:3: section.area: this key is given twice; first in line 2");
}

TEST_CASE("a duplicate key in a list is named with its index") {
  CHECK(complaints_about<Net>(
            "section:\n  ropes:\n  - {area: 1, density: 1}\n  - {area: 1, density: 1, area: 2}\n") ==
        "scene.yaml:4:27: section.ropes[1].area: this key is given twice; first in line 4");
}

TEST_CASE("a wrong unit is refused with what is expected and an example") {
  CHECK(complaints_about<Cable>("section: {area: 4 kg, density: 2}") ==
        "scene.yaml:1:17: section.area: expects an area such as '12.6 mm^2', got '4 kg'");
}

TEST_CASE("an unknown unit is named") {
  CHECK(complaints_about<Cable>("section: {area: 4 smoots, density: 2}") ==
        "scene.yaml:1:17: section.area: expects an area such as '12.6 mm^2', got '4 smoots'; 'smoots' is no "
        "known unit");
}

TEST_CASE("a negative density is refused with its range in the unit of the key") {
  CHECK(complaints_about<Cable>("section: {area: 1, density: -2}") ==
        "scene.yaml:1:29: section.density: must be greater than 0 kg/m^3, but is -2 kg/m^3");
  CHECK(complaints_about<Cable>("section: {area: 1, density: -2 g/cm^3}") ==
        "scene.yaml:1:29: section.density: must be greater than 0 kg/m^3, but is -2 g/cm^3");
}

TEST_CASE("a missing key is named at its section with what it expects") {
  CHECK(complaints_about<Cable>("section: {area: 1}") ==
        "scene.yaml:1:1: section.density: is missing; expects a density such as '7850 kg/m^3'");
}

TEST_CASE("a missing section is named") {
  CHECK(complaints_about<Cable>("section2: {}") ==
        "scene.yaml:1:1: section: this section is missing\n"
        "scene.yaml:1:1: section2: unknown section; did you mean 'section'? known: section, extends");
}

TEST_CASE("a value of another kind is refused with what is expected") {
  CHECK(complaints_about<Cable>("section: {area: [1], density: {}}") ==
        "scene.yaml:1:17: section.area: expects an area such as '12.6 mm^2', got a list of 1\n"
        "scene.yaml:1:31: section.density: expects a density such as '7850 kg/m^3', got a map of keys");
  CHECK(complaints_about<Net>("section: {cells: 2.5, ropes: [3]}") ==
        "scene.yaml:1:18: section.cells: expects a whole number, got '2.5'\n"
        "scene.yaml:1:31: section.ropes[0]: expects a section of keys, got '3'");
  CHECK(complaints_about<Cable>("section: 3") ==
        "scene.yaml:1:10: section: expects a section of keys, got '3'");
  CHECK(complaints_about<Cable>("section:") ==
        "scene.yaml:1:1: section: expects a section of keys, got nothing; write {} for one without keys");
}

TEST_CASE("a number out of a closed range is refused with both ends") {
  CHECK(complaints_about<Net>("section: {cells: 101, ropes: [{area: 1, density: 1}]}") ==
        "scene.yaml:1:18: section.cells: must be between 1 and 100, but is 101");
}

TEST_CASE("a word that is no choice is refused with the choices and the nearest") {
  CHECK(complaints_about<Net>("section: {side: rihgt, ropes: [{area: 1, density: 1}]}") ==
        "scene.yaml:1:17: section.side: expects one of left, right, got 'rihgt'; did you mean 'right'?");
}

TEST_CASE("a list with too few entries is refused") {
  CHECK(complaints_about<Net>("section: {ropes: []}") ==
        "scene.yaml:1:11: section.ropes: needs at least 1 entries, has 0");
  CHECK(complaints_about<Net>("section: {}") ==
        "scene.yaml:1:1: section.ropes: is missing; expects a list of sections");
}

TEST_CASE("a name that would break a column header is refused") {
  CHECK(complaints_about<Net>(
            "section: {parts: {'a,b': {area: 1, density: 1}}, ropes: [{area: 1, density: 1}]}") ==
        "scene.yaml:1:19: section.parts.a,b: a name is made of letters, digits, _ and - only");
}

TEST_CASE("a name needs a character") {
  CHECK(complaints_about<Net>(
            "section: {parts: {'': {area: 1, density: 1}}, ropes: [{area: 1, density: 1}]}") ==
        "scene.yaml:1:19: section.parts.: a name is made of letters, digits, _ and - only");
}

TEST_CASE("a decimal comma in a list of keys is named as one") {
  CHECK(
      complaints_about<Cable>("section: {area: 1, density: 0,5}") ==
      "scene.yaml:1:29: section.density: must be greater than 0 kg/m^3, but is 0 kg/m^3\n"
      "scene.yaml:1:31: section.5: is no key: a comma parts entries here; decimals are written with a point");
}

TEST_CASE("all complaints of a file come at once, in the order of the file") {
  CHECK(complaints_about<Net>("section:\n  parts:\n    net: {area: 4 kg, densty: 2}\n  ropes: [{area: 0, "
                              "density: 1, area: 2}]\n  cells: x\n") ==
        "scene.yaml:3:5: section.parts.net.density: is missing; expects a density such as '7850 kg/m^3'\n"
        "scene.yaml:3:17: section.parts.net.area: expects an area such as '12.6 mm^2', got '4 kg'\n"
        "scene.yaml:3:23: section.parts.net.densty: unknown key; did you mean 'density'? known here: area, "
        "density, prestress\n"
        "scene.yaml:4:18: section.ropes[0].area: must be greater than 0 m^2, but is 0 m^2\n"
        "scene.yaml:4:33: section.ropes[0].area: this key is given twice; first in line 4\n"
        "scene.yaml:5:10: section.cells: expects a whole number, got 'x'");
}

TEST_CASE("a file that is missing, a folder or empty is refused in one sentence") {
  const auto load_error = [](const std::filesystem::path& path) -> std::string {
    try {
      core::SceneFile::load(path);
    } catch (const core::ConfigError& error) {
      return error.what();
    }
    return {};
  };
  CHECK(load_error("no/such/scene.yaml") == "no such file: 'no/such/scene.yaml'");
  CHECK(load_error("/") == "'/' is a folder, not a file");
  CHECK(text_error("") == "scene.yaml: is empty");
  CHECK(text_error(" \n\t\n") == "scene.yaml: is empty");
  CHECK(text_error("# nothing\n") == "scene.yaml: holds no keys, only comments or blanks");
}

TEST_CASE("a text that is no YAML, or no scene, is refused with its place") {
  CHECK(
      text_error("It was a dark and stormy night.") ==
      "scene.yaml:1:1: is no scene: expects lines of 'key: value', found 'It was a dark and stormy night.'");
  CHECK(text_error("a: [1, 2\nb: 3\n") == "scene.yaml:2:2: is not YAML: end of sequence flow not found");
  CHECK(text_error("time: {end: 1\n") == "scene.yaml:2:1: is not YAML: end of map flow not found");
  CHECK(
      text_error("time:\n\tend: 1") ==
      "scene.yaml:2:5: is not YAML: illegal map value (this line is indented with a tab; YAML wants spaces)");
  CHECK(text_error(std::string("\x7f"
                               "ELF\x02\x01\x00\x00",
                               8)) == "scene.yaml:1: holds bytes that are no text");
  CHECK(text_error("- 1\n- 2\n") ==
        "scene.yaml:1:1: is no scene: expects lines of 'key: value', found a list of 2");
  CHECK(text_error("a: 1\n---\nb: 2\n") ==
        "scene.yaml:2:1: a second YAML document starts here; a scene is one document: put it into a file of "
        "its own");
  CHECK(text_error("a: !!python/object 1\n") ==
        "scene.yaml:1:4: scenes use no YAML tags such as 'tag:yaml.org,2002:python/object': write the value "
        "without");
  CHECK(text_error("[a, b]: 1\n") == "scene.yaml:1:1: a key must be a word, not a list or a map");
}

TEST_CASE("bytes that are no UTF-8 are named with their line, wherever they stand") {
  const std::string save = " is no UTF-8 (Latin-1?): save the file as UTF-8";
  CHECK(text_error("time: {end: 1}\ntitle: Felsbl\xf6"
                   "cke\n") == "scene.yaml:2:14: the byte 0xf6" + save);
  CHECK(text_error("# \xe9t\xe9\n") == "scene.yaml:1:3: the byte 0xe9" + save);
  CHECK(text_error("\xe9: 1\n") == "scene.yaml:1:1: the byte 0xe9" + save);
  // Cut short, overlong, half of a surrogate pair, above U+10FFFF [RFC 3629].
  for (const std::string bad : {"\xe2\x82", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80"})
    CHECK_THAT(text_error("a: " + bad), Catch::EndsWith(save));
  CHECK(text_error("title: Felsbl\xc3\xb6"
                   "cke \xe2\x82\xac \xf0\x9f\x97\xbb\n")
            .empty());
  CHECK(text_error(std::string("\xff\xfet\0", 4)) == "scene.yaml: is UTF-16: save the file as UTF-8");
}

TEST_CASE("a message never cuts a character in two") {
  std::string umlauts;
  for (int i = 0; i < 100; ++i) umlauts += "\xc3\xb6";
  for (const char* shift : {"", "a"}) {
    const std::string message = core::quoted(shift + umlauts);
    CHECK(core::utf8_length(message) == message.size());
  }
}

TEST_CASE("a text that YAML misreads is shown in quotes") {
  const auto hint = [](const std::string& text) {
    const std::string message = text_error(text);
    return message.substr(std::min(message.find(" ("), message.size()));
  };
  CHECK(hint("title: Net: with a rock\n") ==
        " (a text with a colon needs quotes: title: \"Net: with a rock\")");
  CHECK(hint("title: Net: with a rock  # old\n") ==
        " (a text with a colon needs quotes: title: \"Net: with a rock\")");
  CHECK(hint("title: the \"big\" one:\n") ==
        " (a text with a colon needs quotes: title: 'the \"big\" one:')");
  CHECK(hint("title: @net\n") == " (a text that starts with @ needs quotes: title: \"@net\")");
  CHECK(hint("title: *net\n") == " (a text that starts with * needs quotes: title: \"*net\")");
  CHECK_THAT(hint("title: 'it's'\n"), Catch::Contains("quotes of the other kind"));
  CHECK_THAT(hint("time: {end: 1, note: a: b}\n"), Catch::Contains("a text with a colon needs quotes"));
  CHECK_THAT(hint("time:\n  end:1\n  step: 2\n"), Catch::Contains("no blank after its colon"));
}

TEST_CASE("merge keys get one message that says what to write instead") {
  CHECK(text_error("base: &b {end: 1}\ntime:\n  <<: *b\n  step: 2\n") ==
        "scene.yaml:3:3: merge keys are not read: write the keys out, or put them into a scene that this one "
        "`extends`");
}

TEST_CASE("pipes and devices are refused at once as scene, base and file of a key") {
  test::Folder folder("scene_errors");
  const std::filesystem::path pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  folder.add("scene.yaml", "extends: pipe\n").add("device.yaml", "extends: /dev/zero\n");
  const auto load_error = [](const std::filesystem::path& path) -> std::string {
    try {
      core::SceneFile::load(path);
    } catch (const core::ConfigError& error) {
      return error.what();
    }
    return {};
  };
  CHECK(load_error(pipe) == "'" + pipe.string() + "' is a named pipe, not a file");
  CHECK(load_error("/dev/zero") == "'/dev/zero' is a device, not a file");
  CHECK(load_error(folder / "scene.yaml") == (folder / "scene.yaml").string() + ":1:10: extends: '" +
                                                 pipe.string() + "' is a named pipe, not a file");
  CHECK_THAT(load_error(folder / "device.yaml"),
             Catch::EndsWith("extends: '/dev/zero' is a device, not a file"));
}

TEST_CASE("ten megabytes of brackets end in one clean complaint") {
  CHECK(text_error(std::string(10 << 20, '[')) == "scene.yaml:1:65: more than 64 brackets are open here");
  CHECK(text_error("a: " + std::string(10 << 20, '{')) ==
        "scene.yaml:1:68: more than 64 brackets are open here");
  std::string dashes;
  for (int i = 0; i < 1 << 20; ++i) dashes += "- ";
  CHECK(text_error(dashes) == "scene.yaml:1:129: nested deeper than 64 levels");
}

TEST_CASE("a text of more than 16 MB or a million values is refused") {
  CHECK(text_error(std::string(17 << 20, 'a')) == "scene.yaml: is larger than 16 MB, which no scene is");
  std::string many = "a: [0";
  for (int i = 0; i < 1000000; ++i) many += ",0";
  CHECK_THAT(text_error(many + "]"), Catch::EndsWith("holds more than 1000000 values"));
}

TEST_CASE("aliases that multiply or loop are refused, others repeat what they name") {
  std::string laughs = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 10; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    laughs += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int j = 0; j < 10; ++j) laughs += (j ? ", " : "") + before;
    laughs += "]\n";
  }
  CHECK_THAT(text_error(laughs), Catch::EndsWith("holds more than 1000000 values"));
  CHECK(text_error("a: &a [*a]\n") ==
        "scene.yaml:1:8: an alias stands inside of what it names, and would loop");
  Net net;
  CHECK(complaints_about("section: {ropes: [&r {area: 1, density: 2}, *r]}", net).empty());
  REQUIRE(net.ropes.size() == 2);
  CHECK(net.ropes[1].density == 2);
}

}  // namespace talus
