#pragma once

#include "interface_mesh/scene/panel.hpp"

namespace talus::mesh {

/// `square_net:` a net of square openings.
struct SquareNetScene {
  PanelScene panel;
  double pitch = 0;          ///< m; between neighbouring wires
  double wire_diameter = 0;  ///< m
  enum class Rim { wires, open } rim = Rim::wires;
};
void describe(core::Fields& fields, SquareNetScene& net);

/// @pre the scene was read without complaints
Net generate(const SquareNetScene& net);

}  // namespace talus::mesh
