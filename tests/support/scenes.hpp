#pragma once

#include <string>

#include "core/scene/reader.hpp"

/// Helpers for tests of scene sections.
namespace talus::test {

/// The complaints about `yaml`, which stands under the key `section`, one a line; empty where it is read
/// without any.
template <class Section>
std::string complaints_about(const std::string& yaml, Section& section, const std::string& key = "section") {
  try {
    const auto file = core::SceneFile::parse(yaml, "scene.yaml");
    core::SceneReader reader(file, {key, "extends"});
    section = reader.required<Section>(key);
    reader.finish();
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return {};
}
template <class Section>
std::string complaints_about(const std::string& yaml) {
  Section section;
  return complaints_about(yaml, section);
}

}  // namespace talus::test
