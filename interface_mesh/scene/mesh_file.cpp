#include "interface_mesh/scene/mesh_file.hpp"

#include "interface_mesh/files/mesh_file.hpp"
#include "interface_mesh/surface_checks.hpp"

namespace talus::mesh {

void describe(core::Fields& fields, MeshFileScene& file) {
  fields.required("path", file.path,
                  {.help = "a Gmsh 4.1 text file (.msh), .stl, .obj or .ply, from this file's folder"});
  fields.with_default("unit", file.unit,
                      {.unit = "m", .range = core::positive, .help = "length of one unit of the file"});
  fields.optional("part", file.part, {.help = "the physical group or object to take; absent: all"});
}

Net generate(const MeshFileScene& file) {
  Net net = read_mesh_file(file.path);
  if (file.part) net = extract_part(net, *file.part);
  for (double& coordinate : net.surface.positions) coordinate *= file.unit;
  check(net.surface, file.path.string());
  return net;
}

}  // namespace talus::mesh
