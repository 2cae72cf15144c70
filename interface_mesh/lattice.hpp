#pragma once

#include <array>
#include <vector>

#include "interface_mesh/panel.hpp"

namespace talus::mesh {

/// Wires of one thickness in a pattern.
struct LatticePart {
  const char* name = "";
  double wire_radius = 0;  ///< m; of what a rock touches
  int wires = 1;           ///< side by side in each link
};

/// A straight piece of wire from a node of one cell to a node of the same or a neighbouring cell.
struct LatticeLink {
  std::size_t from = 0, to = 0;
  std::array<int, 2> step{};  ///< cells along and across from the cell of `from` to that of `to`
  std::size_t part = 0;
};

/// A wire pattern that repeats in rectangular cells.
struct Lattice {
  Vector2 cell{0, 0};          ///< m; along and across
  std::vector<Vector2> nodes;  ///< m; from the cell's corner
  std::vector<LatticeLink> links;
  std::vector<LatticePart> parts;
};

/// Lattice nodes nearer to the outline than this part of the shortest link are moved onto it, so that no tiny
/// pieces of wire remain there.
inline constexpr double snap_of_link = 0.05;

/// The pattern within a panel, its first cell at the lower corner of the outline's bounding box. Wires are
/// cut where they cross the outline; their ends there are the net's rim. Segments are in the order of the
/// parts.
/// @throws core::ConfigError if no wire is inside
Net clip(const Lattice& lattice, const Panel& panel);

}  // namespace talus::mesh
