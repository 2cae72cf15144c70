#pragma once

#include <string>

#include "core/errors.hpp"
#include "core/scene/reader.hpp"
#include "fem_solver/app/structure.hpp"

namespace talus::fem::tests {

/// A scene of a structure, from its YAML body indented by two spaces.
inline StructuralScene scene(const std::string& structure) {
  return read_structural_scene(
      core::SceneFile::parse("time: {end: 1 s}\nstructure:\n" + structure, "scene.yaml"));
}

/// What is said about a structure that cannot be built.
inline std::string complaint(const std::string& structure) {
  try {
    Structure built(scene(structure));
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "no complaint";
}

}  // namespace talus::fem::tests
