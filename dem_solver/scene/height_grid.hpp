#pragma once

#include <filesystem>

#include "core/scene/fields.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::dem {

/// `height_grid:` terrain from an Esri ASCII grid (.asc), as land surveys publish it.
struct HeightGridScene {
  std::filesystem::path path;
  core::Vector3 origin = core::Vector3::Zero();  ///< m; the point of the map where the scene's origin is
};
void describe(core::Fields& fields, HeightGridScene& grid);

/// The heights as nodes, two triangles between each four neighbours, cut along the diagonal that is less
/// steep. Where a height is missing there is a hole.
/// @throws core::ConfigError if the file cannot be read or is no such grid
mesh::Surface height_grid(const HeightGridScene& grid);

}  // namespace talus::dem
