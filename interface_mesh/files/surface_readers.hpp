#pragma once

#include "interface_mesh/files/scanner.hpp"
#include "interface_mesh/net.hpp"

/// Readers of surface files. All read what stands in the file, in double precision: corners at exactly the
/// same place become one node, no other ones do, no cell is dropped, and lines are kept beside faces.
/// Cells list the solids, objects, groups and materials they stand in (Net::cell_sets). Nodes that no cell
/// uses are left out. Faces of more than three corners are cut into triangles.
/// @throws core::ConfigError "FILE:LINE: ..." for what cannot be read
namespace talus::mesh {

/// Stereolithography (3D Systems 1988): text or binary, any number of solids one after the other. Whether a
/// file is binary follows from its length, because binary files may begin with `solid`, too. Triangles are
/// turned by the order of their corners; normals and attributes are passed over.
Net read_stl(Scanner text);

/// Wavefront OBJ: polygons and polylines of vertices, negative indices, objects, groups and materials.
/// Texture, normals and colours are passed over; free-form curves and surfaces are refused.
Net read_obj(Scanner text);

/// PLY (Turk 1994), text, little and big endian, with any properties: vertices, faces and edges. Triangle
/// strips are refused.
Net read_ply(Scanner text);

}  // namespace talus::mesh
