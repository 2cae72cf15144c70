#pragma once

#include <filesystem>
#include <string>

#include "interface_mesh/net.hpp"

/// Meshes in files, by the end of their name: .msh (Gmsh 4.1 and 2.2, gmsh.hpp), .stl, .obj, .ply
/// (surface_readers.hpp), all read and written in double precision.
namespace talus::mesh {

/// The groups, solids, objects and materials of a file become cell sets.
/// @throws core::ConfigError if the file cannot be read, is of another kind, or holds neither lines nor
/// triangles
Net read_mesh_file(const std::filesystem::path& path);

/// .stl, .obj and .ply take triangles only (tubes.hpp makes them from wires).
/// @throws core::ConfigError if the file cannot be written or the kind does not take the mesh
void write_mesh_file(const Net& net, const std::filesystem::path& path);

/// The cells of a group with the net's own numbers of nodes, turned as the group lists its triangles.
struct GroupCells {
  std::vector<std::array<Index, 2>> segments;
  std::vector<std::array<Index, 3>> triangles;
};
/// @throws core::ConfigError naming the groups there are, if it is not among them
GroupCells cells_of_group(const Net& net, const std::string& group);

/// One of a file's cell sets alone, turned as it lists its triangles, with the nodes it uses and the node
/// sets cut down to them.
/// @throws core::ConfigError naming the sets there are, if it is not among them
Net extract_part(const Net& net, const std::string& part);

}  // namespace talus::mesh
