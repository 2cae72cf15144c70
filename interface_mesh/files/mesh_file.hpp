#pragma once

#include <filesystem>
#include <string>

#include "interface_mesh/net.hpp"

/// Meshes in files, by the end of their name: .msh (Gmsh 4.1, gmsh.hpp), .stl, .obj, .ply (through assimp,
/// which keeps coordinates in single precision: 7 digits).
namespace talus::mesh {

/// Objects of .obj, .ply and .stl files become parts; corners at the same place become one node. Lines of
/// .obj files are read.
/// @throws core::ConfigError if the file cannot be read, is of another kind, or holds neither lines nor
/// triangles
Net read_mesh_file(const std::filesystem::path& path);

/// .stl, .obj and .ply take triangles only (tubes.hpp makes them from wires).
/// @throws core::ConfigError if the file cannot be written or the kind does not take the mesh
void write_mesh_file(const Net& net, const std::filesystem::path& path);

/// One part alone, with the nodes it uses and the node sets cut down to them.
/// @throws core::ConfigError naming the parts there are, if it is not among them
Net extract_part(const Net& net, const std::string& part);

}  // namespace talus::mesh
