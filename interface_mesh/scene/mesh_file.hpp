#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/scene/fields.hpp"
#include "interface_mesh/net.hpp"

namespace talus::mesh {

/// `mesh_file:` a mesh made elsewhere.
struct MeshFileScene {
  std::filesystem::path path;
  double unit = 1;                  ///< m; the length of one unit of the file
  std::optional<std::string> part;  ///< absent: all
};
void describe(core::Fields& fields, MeshFileScene& file);

/// @throws core::ConfigError if the file cannot be read, has no such part, or its mesh has faults
/// (surface_checks.hpp)
Net generate(const MeshFileScene& file);

}  // namespace talus::mesh
