#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "core/scene/reader.hpp"
#include "core/scene/sections.hpp"

/// Feeds arbitrary bytes to the scene reader. It may refuse them with a ConfigError and must do nothing else:
/// no crash, no undefined behaviour, no leak, no other exception, no endless run. What it accepts must read
/// back from its canonical text as the same scene.
namespace talus {
namespace {

enum class Colour { red, green };
struct Leaf {
  double length = 0;
  std::vector<std::pair<double, double>> table;
};
void describe(core::Fields& fields, Leaf& leaf) {
  fields.required("length", leaf.length, {.unit = "m", .range = core::positive, .help = "h"});
  fields.with_default("table", leaf.table, {.unit = "m, N", .help = "h"});
}
/// Has a key of every kind.
struct Everything {
  std::int64_t count = 0;
  bool flag = false;
  std::string word;
  std::filesystem::path path;
  core::Vector3 point = core::Vector3::Zero();
  std::vector<double> numbers;
  std::vector<std::int64_t> counts;
  std::vector<std::string> words;
  std::vector<core::Vector3> points;
  Colour colour = Colour::red;
  std::optional<Leaf> leaf;
  std::vector<Leaf> list;
  std::vector<std::pair<std::string, Leaf>> map;
  std::variant<std::monostate, Leaf, core::TimeScene> either;
};
void describe(core::Fields& fields, Everything& all) {
  fields.with_default("count", all.count, {.range = core::not_negative, .help = "h"});
  fields.with_default("flag", all.flag, {.help = "h"});
  fields.with_default("word", all.word, {.help = "h"});
  fields.with_default("path", all.path, {.help = "h"});
  fields.with_default("point", all.point, {.unit = "m", .help = "h"});
  fields.with_default("numbers", all.numbers, {.unit = "Pa", .help = "h"});
  fields.with_default("counts", all.counts, {.help = "h"});
  fields.with_default("words", all.words, {.help = "h"});
  fields.with_default("points", all.points, {.unit = "m/s", .help = "h"});
  fields.choice("colour", all.colour, {"red", "green"}, "h");
  fields.section("leaf", all.leaf, "h");
  fields.list("list", all.list, "h");
  fields.map("map", all.map, "h");
  fields.one_of(all.either, {{"this", "h"}, {"that", "h"}});
}

void read(const std::string& text) {
  auto file = core::SceneFile::parse(text, "fuzzed.yaml");
  const auto copy = core::SceneFile::parse(file.text(), "copy.yaml");
  if (copy.hash() != file.hash()) __builtin_trap();
  core::SceneReader reader(file);
  reader.required<core::TimeScene>("time");
  reader.optional<core::OutputScene>("output");
  reader.optional<Everything>("structure");
  reader.optional<Everything>("particles");
  reader.finish();
}

}  // namespace
}  // namespace talus

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    talus::read(std::string(reinterpret_cast<const char*>(data), size));
  } catch (const talus::core::ConfigError&) {
  }
  return 0;
}
