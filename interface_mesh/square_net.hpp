#pragma once

#include <array>

#include "core/vector3.hpp"
#include "interface_mesh/net.hpp"

namespace talus::mesh {

/// A rectangular net of square (or, where the lengths call for it, rectangular) openings, wires along both
/// axes.
struct SquareNet {
  core::Vector3 corner = core::Vector3::Zero();  ///< m; the south-west one
  core::Vector3 along = core::Vector3::UnitX();  ///< direction of the south edge; any length
  core::Vector3 across =
      core::Vector3::UnitY();       ///< direction of the west edge; any length, not parallel to `along`
  std::array<double, 2> lengths{};  ///< m; of the south and the west edge
  std::array<Index, 2> openings{};  ///< number of openings along each
  double wire_diameter = 0;         ///< m
};

/// Nodes row by row from the corner, (openings[0] + 1)(openings[1] + 1) of them; segments along the rows
/// first, then across. One part, `wire`. @pre lengths > 0, openings >= 1
Net generate(const SquareNet& net);

}  // namespace talus::mesh
