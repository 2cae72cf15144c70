#pragma once

#include <string>

#include "interface_mesh/surface.hpp"

namespace talus::dem {

/// Why a surface is no rock, in one sentence with places; empty for one closed shell that faces outwards and
/// does not cross itself. Told apart: no triangles, edges of one triangle (open), of more than two (bodies
/// that touch, walls inside) or run along twice in the same direction (a triangle turned over), a shell that
/// crosses itself, bodies that reach into each other, a shell inside of another, several bodies, a shell
/// turned inside out. Triangles that only touch do not cross. O(n log n) for n triangles of a surface without
/// faults.
/// @pre mesh::check passes
std::string closed_surface_fault(const mesh::Surface& surface);

/// Turns every triangle over where the surface as a whole is inside out: a closed surface's outside is known.
/// @return whether it was
bool turn_outwards(mesh::Surface& surface);

}  // namespace talus::dem
