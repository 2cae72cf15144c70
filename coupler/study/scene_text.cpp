#include "coupler/study/scene_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/scene/tree.hpp"

namespace talus::study {
namespace {

/// "a.b.c" and a value as the nested maps {a: {b: {c: value}}}.
core::SceneNode nested(const Setting& setting) {
  std::string text, closing;
  for (std::size_t begin = 0; begin <= setting.key.size();) {
    const std::size_t end = std::min(setting.key.find('.', begin), setting.key.size());
    text += (begin == 0 ? "" : "{") + setting.key.substr(begin, end - begin) + ": ";
    if (begin != 0) closing += "}";
    begin = end + 1;
  }
  std::vector<core::Complaint> complaints;
  auto node = core::parse_yaml(text + setting.value + closing, "setting of " + setting.key, complaints);
  if (!complaints.empty())
    throw core::ConfigError(fmt::format("{}: cannot be set to {}", setting.key, core::quoted(setting.value)));
  return node;
}

}  // namespace

std::string scene_text(const std::vector<Setting>& settings, const std::filesystem::path& base) {
  core::SceneNode scene =
      nested({"extends", core::canonical_text({core::SceneNode::Kind::scalar, {}, base.string()})});
  for (const auto& setting : settings) scene = core::overlay(std::move(scene), nested(setting), 0);
  return core::canonical_text(scene) + "\n";
}

}  // namespace talus::study
