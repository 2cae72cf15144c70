#pragma once

#include <iosfwd>

#include "interface_mesh/surface.hpp"

/// Triangles as text, with the shortest digits that read back as the same numbers. What is not finite or has
/// no place in the format (parts, wires) is not written. @pre check(surface) passes
namespace talus::mesh {

void write_stl(std::ostream& out, const Surface& surface);
void write_obj(std::ostream& out, const Surface& surface);
void write_ply(std::ostream& out, const Surface& surface);

}  // namespace talus::mesh
