#pragma once

#include <vector>

#include "interface_mesh/scene/panel.hpp"

namespace talus::mesh {

/// `sheet:` a panel filled with triangles.
struct SheetScene {
  PanelScene panel;
  std::optional<double> element_size;               ///< m
  std::optional<std::vector<double>> crossed_cell;  ///< m; along and across
  std::optional<double> edge_spacing;               ///< m; absent: the element size
  std::vector<core::Vector3> edge_nodes;            ///< m; on the outline
};
void describe(core::Fields& fields, SheetScene& sheet);

/// @pre the scene was read without complaints
Net generate(const SheetScene& sheet);

}  // namespace talus::mesh
