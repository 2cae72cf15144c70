#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/scene/reader.hpp"

/// What a restart compares: the scene that a checkpoint was written for, and the one it goes on with.
namespace talus::coupler {

/// A scene's values by their keys, "particles.rocks.block.velocity[1]" -> "-25 m/s", and the contents of the files it
/// names, "content of net.msh" -> a digest, in the order of the keys.
using FlatScene = std::map<std::string, std::string>;
FlatScene flattened(const core::SceneFile& file);
/// A line "key: value" for each, and back.
std::string text_of(const FlatScene& scene);
FlatScene flat_scene(const std::string& text);

/// A key whose value is another one; empty where there is none.
struct ChangedKey {
  std::string key, before, now;
  /// "particles.rocks.block.velocity[1]: -25 m/s, in the checkpoint 0"
  std::string text() const;
};

struct SceneDifference {
  /// Keys that say how something is at time 0: a restart has that from the checkpoint.
  std::vector<ChangedKey> state;
  /// Keys that the run goes on with.
  std::vector<ChangedKey> changed;
};
/// Without what may differ freely: the title, how long the run is, what is written, and how long is waited.
SceneDifference difference(const FlatScene& before, const FlatScene& now);

/// A line for each, indented; the last ones of many are only counted.
std::string lines_of(const std::vector<ChangedKey>& keys);

}  // namespace talus::coupler
