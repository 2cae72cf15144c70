#pragma once

#include <optional>
#include <vector>

#include "core/scene/fields.hpp"
#include "interface_mesh/panel.hpp"

namespace talus::mesh {

/// Where a net or sheet is, by keys beside its own: a rectangle (`corner`, `size`, and its directions where
/// they are not x and y) or any flat outline (`outline`).
struct PanelScene {
  std::optional<core::Vector3> corner;                ///< m; south-west
  std::optional<std::vector<double>> size;            ///< m; of the south and of the west edge
  std::optional<core::Vector3> along;                 ///< direction of the south edge; absent: x
  std::optional<core::Vector3> across;                ///< direction of the west edge; absent: y
  std::optional<std::vector<core::Vector3>> outline;  ///< m

  bool is_rectangle() const { return !outline; }
  /// Whether a panel can be made: not so while a scene with complaints is read.
  bool is_complete() const { return outline ? outline->size() >= 3 : corner && size && size->size() == 2; }
};
/// Reads the keys at the level of the section that holds the panel.
void describe(core::Fields& fields, PanelScene& panel);

/// @pre the scene was read without complaints
Panel make_panel(const PanelScene& panel);

}  // namespace talus::mesh
