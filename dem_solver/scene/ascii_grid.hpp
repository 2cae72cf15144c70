#pragma once

#include <filesystem>
#include <vector>

#include "core/vector3.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::dem {

/// Heights at the nodes of a rectangular grid, in metres.
struct AsciiGrid {
  mesh::Index columns = 0, rows = 0;
  double column_width = 0, row_width = 0;        ///< m
  core::Vector3 corner = core::Vector3::Zero();  ///< m; the south-western node, z = 0
  std::vector<double> heights;  ///< row by row, the northernmost first; NaN where there is none

  /// Row 0 is the southernmost.
  double height(mesh::Index column, mesh::Index row) const {
    return heights[static_cast<std::size_t>(rows - 1 - row) * columns + column];
  }
};

/// Reads an Esri ASCII raster and its dialects: keys in any case, `cellsize` or `dx` and `dy`, corners or centres,
/// any blanks and ends of lines, with or without the mark of UTF-8. A height is missing where it is NaN or the
/// header's NODATA_value (-9999 where the header names none), compared in single precision, in which many
/// programs keep it.
/// @throws core::ConfigError with file, line and value where the file is no such grid, or its heights cannot be
/// meant: voids that the header does not declare, degrees as lengths
AsciiGrid read_ascii_grid(const std::filesystem::path& path);

}  // namespace talus::dem
