#pragma once

#include <optional>
#include <vector>

#include "core/scene/fields.hpp"
#include "interface_mesh/net.hpp"

namespace talus::mesh {

/// `square_net:` a rectangular net, `corner` plus `size[0]` along the first direction and `size[1]` along the
/// second.
struct SquareNetScene {
  core::Vector3 corner = core::Vector3::Zero();  ///< m
  std::vector<double> size;                      ///< m; two
  double pitch = 0;                              ///< m; between neighbouring wires
  core::Vector3 along = core::Vector3::UnitX();
  core::Vector3 across = core::Vector3::UnitY();
  double wire_diameter = 0;  ///< m
};
void describe(core::Fields& fields, SquareNetScene& net);

/// @pre the scene was read without complaints
Net generate(const SquareNetScene& net);

}  // namespace talus::mesh
