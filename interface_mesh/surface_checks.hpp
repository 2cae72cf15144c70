#pragma once

#include <string>
#include <vector>

#include "interface_mesh/surface.hpp"

namespace talus::mesh {

/// Whether a segment there and one back are the same: in lines they are, around a ring of two nodes they are not.
enum class Segments { either_way, directed };

/// What is wrong with a surface, one sentence a fault with the entity and its coordinates (m); empty for a
/// sound one. Looks for: incomplete or non-finite positions, part ranges and node indices outside the arrays,
/// segments shorter than 1e-12 of the surface's extent, triangles whose height is below 1e-10 of their
/// longest edge, two triangles that run the same way along their common edge (one is turned over), and nodes
/// that no segment or triangle uses, and cells that are there twice. At most ten of a kind are written out.
std::vector<std::string> faults(const Surface& surface, Segments segments = Segments::either_way);
/// Of these, segments without length and triangles without area alone. @pre positions and indices are sound
std::vector<std::string> flat_cells(const Surface& surface);

/// @throws core::ConfigError with every fault, headed by `what`, e.g. "structure.parts.net".
void check(const Surface& surface, const std::string& what, Segments segments = Segments::either_way);

}  // namespace talus::mesh
