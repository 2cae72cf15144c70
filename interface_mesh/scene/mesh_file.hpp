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
  double unit = 1;                               ///< m; the length of one unit of the file
  core::Vector3 origin = core::Vector3::Zero();  ///< m; the point of the file where the scene's origin is
  std::optional<std::string> part;               ///< absent: all
  std::optional<double> join;                    ///< m; absent: nodes that nearly touch are an error
};
void describe(core::Fields& fields, MeshFileScene& file);

/// @throws core::ConfigError if the file cannot be read, has no such part, its mesh has faults
/// (surface_checks.hpp), or loose nodes nearly touch each other and the scene does not say what to do with
/// them (near_nodes.hpp)
Net generate(const MeshFileScene& file);

}  // namespace talus::mesh
