#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "interface_mesh/net.hpp"

/// Gmsh's text formats 4.1 and 2.2 (Gmsh reference manual, section "MSH file format"): lines, triangles and
/// quadrangles of first order.
namespace talus::mesh {

/// Physical groups of lines and surfaces become cell sets, which may overlap; what the same groups list
/// becomes a part, and what belongs to no group the part "". Every physical group, those of points too, is a
/// node set; `nodes` is all. A negative group number turns its elements over. Elements of a partitioned mesh
/// are in the groups of what was cut. Quadrangles are cut in two. Nodes that no line, triangle or group uses
/// are left out. Nodes are joined as the file numbers them.
/// @throws core::ConfigError "FILE:LINE: ..." for a binary file, another version, an element of another kind,
/// an element or node that is there twice, an entity that is not there, a group's name with a comma or
/// quotation mark, numbers that are missing, not finite or out of range.
Net read_gmsh(const std::filesystem::path& path);
Net parse_gmsh(std::istream& text, const std::string& name);

/// Parts become physical groups of their cells, node sets other than `nodes` physical groups of points.
/// @throws core::ConfigError if the file cannot be written
void write_gmsh(const Net& net, const std::filesystem::path& path);

}  // namespace talus::mesh
