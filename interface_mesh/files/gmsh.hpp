#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "interface_mesh/net.hpp"

/// Gmsh's text format, version 4.1 (Gmsh reference manual, section "MSH file format"): lines and triangles of
/// first order.
namespace talus::mesh {

/// Physical groups of lines and surfaces become parts, in the file's order; what belongs to no group becomes
/// the part "". Every physical group, those of points too, is a node set; `nodes` is all. Quadrangles are cut
/// in two. Nodes that no line, triangle or group uses are left out.
/// @throws core::ConfigError "FILE:LINE: ..." for a binary file, another version, an element of another kind,
/// numbers that are missing, not finite or out of range.
Net read_gmsh(const std::filesystem::path& path);
Net parse_gmsh(std::istream& text, const std::string& name);

/// Parts become physical groups of their cells, node sets other than `nodes` physical groups of points.
/// @throws core::ConfigError if the file cannot be written
void write_gmsh(const Net& net, const std::filesystem::path& path);

}  // namespace talus::mesh
