#include "interface_mesh/scene/mesh_file.hpp"

#include "core/errors.hpp"
#include "interface_mesh/files/mesh_file.hpp"
#include "interface_mesh/near_nodes.hpp"
#include "interface_mesh/surface_checks.hpp"

namespace talus::mesh {

void describe(core::Fields& fields, MeshFileScene& file) {
  fields.required(
      "path", file.path,
      {.help = "a Gmsh text file (.msh, version 4.1 or 2.2), .stl, .obj or .ply, from this file's folder"});
  fields.with_default("unit", file.unit,
                      {.unit = "m", .range = core::positive, .help = "length of one unit of the file"});
  fields.with_default("origin", file.origin,
                      {.unit = "m", .help = "the point of the file where the scene's origin is"});
  fields.optional("part", file.part,
                  {.help = "the physical group, object, group, material or solid to take; absent: all"});
  fields.optional(
      "join", file.join,
      {.unit = "m",
       .range = core::not_negative,
       .help = "joins nodes up to this distance; absent: only what is at the same place, and an error where "
               "nodes nearly are, or lie on the edge of another cell"});
}

namespace {

/// Map coordinates have seven digits before the point: the origin is taken off before anything rounds them.
void place(Surface& surface, const MeshFileScene& file) {
  for (std::size_t k = 0; k < surface.positions.size(); ++k)
    surface.positions[k] = surface.positions[k] * file.unit - file.origin[static_cast<Eigen::Index>(k % 3)];
}

Net read(const MeshFileScene& file) {
  Net net = read_mesh_file(file.path);
  try {
    return file.part ? extract_part(net, *file.part) : net;
  } catch (const core::ConfigError& error) {
    throw core::ConfigError(file.path.string() + ": " + error.what());
  }
}

}  // namespace

Net generate(const MeshFileScene& file) {
  Net net = read(file);
  place(net.surface, file);
  if (file.join) net = join_near_nodes(net, *file.join, file.path.string());
  check(net.surface, file.path.string());
  if (!file.join) refuse_torn(net.surface, file.path.string());
  return net;
}

}  // namespace talus::mesh
