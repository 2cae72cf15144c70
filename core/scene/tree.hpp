#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/errors.hpp"

/// A scene as a tree whose every key and value knows the place it was written at.
namespace talus::core {

struct Place {
  std::shared_ptr<const std::filesystem::path> file = {};
  int line = 0;  ///< from 1
  int column = 0;
};

/// "scene.yaml" or, where the place has a line, "scene.yaml:12".
std::string text(const Place& place);

struct SceneEntry;

struct SceneNode {
  enum class Kind { null, scalar, list, map };

  SceneNode() = default;
  SceneNode(Kind a_kind, Place a_place, std::string a_scalar = {});

  Kind kind = Kind::null;
  Place place;
  std::string scalar;
  std::vector<SceneNode> items;     ///< of a list
  std::vector<SceneEntry> entries;  ///< of a map, in the order of the file

  const SceneEntry* find(const std::string& key) const;
  SceneEntry* find(const std::string& key);
};

/// A key of a map with its value.
struct SceneEntry {
  std::string key;
  Place place;  ///< of the key
  int rank =
      0;  ///< counts overlays: an entry of a later file has a higher rank than those of the files it extends
  SceneNode value;
};

/// "a map", "the number or text '4 mm'", ... for error messages; long texts are cut.
std::string shown(const SceneNode& node);
std::string quoted(const std::string& text);

Complaint complaint(const Place& place, const std::string& key_path, const std::string& message);

/// Reads YAML text. Duplicate keys are complained about and dropped. Whatever stops the reading (no YAML,
/// empty, deeper than 64, larger than 16 MB, more than a million values, an alias that loops) is the last
/// complaint, and the tree is then empty.
SceneNode parse_yaml(const std::string& text, const std::filesystem::path& file,
                     std::vector<Complaint>& complaints);

/// Puts `over` on `base`: maps are merged key by key, lists and scalars replaced, a null removes the base's
/// key. Entries of `over` get the rank `rank`.
SceneNode overlay(SceneNode base, const SceneNode& over, int rank);

/// The tree as YAML in one canonical spelling, so that layout and comments of the file do not matter.
std::string canonical_text(const SceneNode& node);

/// The name of `known` nearest to `name`, if near enough to be a slip of the fingers; else empty.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

}  // namespace talus::core
