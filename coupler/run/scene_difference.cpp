#include "coupler/run/scene_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>
#include <sstream>

#include "core/input_file.hpp"
#include "core/scene/tree.hpp"
#include "core/units/units.hpp"

namespace talus::coupler {
namespace {

/// Adds the values below `node`, whose key is `key`.
void flatten(const core::SceneNode& node, const std::string& key, FlatScene& flat) {
  using Kind = core::SceneNode::Kind;
  if (node.kind == Kind::map && !node.entries.empty()) {
    for (const auto& entry : node.entries)
      flatten(entry.value, key.empty() ? entry.key : key + "." + entry.key, flat);
  } else if (node.kind == Kind::list && !node.items.empty()) {
    for (std::size_t i = 0; i < node.items.size(); ++i)
      flatten(node.items[i], fmt::format("{}[{}]", key, i), flat);
  } else {
    // A line break inside of a text would look like the next key.
    std::string value = node.kind == Kind::scalar ? node.scalar : core::canonical_text(node);
    std::ranges::replace(value, '\n', ' ');
    flat[key] = std::move(value);
  }
}

/// How a run may be changed without a word: what it computes stays the same.
bool may_differ(const std::string& key) {
  static constexpr std::array free{"title",
                                   "time.end",
                                   "output.",
                                   "regression.",
                                   "coupling.timeout",
                                   "coupling.join_timeout",
                                   "structure.solver.timeout",
                                   "structure.solver.join_timeout",
                                   "particles.solver.timeout",
                                   "particles.solver.join_timeout",
                                   "coupling.checkpoint_every",
                                   "particles.threads"};
  return std::ranges::any_of(free, [&](const char* start) { return key.starts_with(start); });
}

bool is_state(const std::string& key) {
  static const std::regex at_time_0(
      R"(particles\.(spheres|rocks)\.[^.]+\.(at|velocity|spin|turned)\b.*)"
      R"(|particles\.streams\.[^.]+\.(low|high|velocity|seed)\b.*)"
      R"(|structure\.initial_(velocities|displacements)\b.*)"
      R"(|structure\.parts\.[^.]+\.(square_net|rhombic_net|hexagonal_net|ring_net|sheet)"
      R"(|mesh_file|polyline|mesh|through|group)\..*|structure\.mesh_file\..*)");
  return std::regex_match(key, at_time_0);
}

/// The same text, or the same quantity in other words: "4 mm" and "0.004 m".
bool same_value(const std::string& one, const std::string& other) {
  if (one == other) return true;
  const auto space = other.find(' ');
  const std::string unit = space == std::string::npos ? "" : other.substr(space + 1);
  const auto a = core::parse_quantity(one, unit), b = core::parse_quantity(other, unit);
  return a && b && *a == *b;
}

}  // namespace

FlatScene flattened(const core::SceneFile& file) {
  std::vector<core::Complaint> ignored;  // the text is the file's own, read before
  FlatScene flat;
  flatten(core::parse_yaml(file.text(), file.path(), ignored), "", flat);
  for (const auto& named : file.named_files())
    flat["content of " + named.filename().string()] = "digest " + core::digest_of_content(named);
  return flat;
}

std::string text_of(const FlatScene& scene) {
  std::string text;
  for (const auto& [key, value] : scene) text += key + ": " + value + "\n";
  return text;
}

FlatScene flat_scene(const std::string& text) {
  FlatScene scene;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const auto colon = line.find(": "); colon != std::string::npos)
      scene[line.substr(0, colon)] = line.substr(colon + 2);
  return scene;
}

std::string ChangedKey::text() const {
  const std::string present = now.empty() ? key + " is gone" : key + ": " + now;
  return before.empty() ? present + ", new against the checkpoint"
                        : present + ", in the checkpoint " + before;
}

SceneDifference difference(const FlatScene& before, const FlatScene& now) {
  FlatScene all = before;
  all.insert(now.begin(), now.end());
  const auto value_in = [](const FlatScene& scene, const std::string& key) {
    const auto found = scene.find(key);
    return found == scene.end() ? std::string() : found->second;
  };
  SceneDifference different;
  for (const auto& [key, any] : all) {
    const ChangedKey changed{key, value_in(before, key), value_in(now, key)};
    if (may_differ(key) || same_value(changed.before, changed.now)) continue;
    (is_state(key) ? different.state : different.changed).push_back(changed);
  }
  return different;
}

std::string lines_of(const std::vector<ChangedKey>& keys) {
  constexpr std::size_t most = 20;
  std::string lines;
  for (std::size_t i = 0; i < std::min(most, keys.size()); ++i) lines += "\n  " + keys[i].text();
  if (keys.size() > most) lines += fmt::format("\n  and {} more", keys.size() - most);
  return lines;
}

}  // namespace talus::coupler
