#pragma once

#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "interface_mesh/net_patterns.hpp"
#include "interface_mesh/scene/panel.hpp"
#include "interface_mesh/scene/square_net.hpp"

/// The nets a scene can name, each in a panel.
namespace talus::mesh {

/// `rhombic_net:` chain-link, by its diagonals or by its opening and mesh angle.
struct RhombicNetScene {
  PanelScene panel;
  double wire_diameter = 0;                      ///< m
  std::optional<std::vector<double>> diagonals;  ///< m; along and across
  std::optional<double> opening;                 ///< m; of the largest sphere that passes
  std::optional<double> angle;                   ///< rad; of a mesh at its upper and lower end

  RhombicPattern pattern() const;
};
void describe(core::Fields& fields, RhombicNetScene& net);

/// `hexagonal_net:` double twist.
struct HexagonalNetScene {
  PanelScene panel;
  std::vector<double> mesh_size;  ///< m; distance of twists, length of an opening
  double twist_length = 0;        ///< m
  double wire_diameter = 0;       ///< m

  HexagonalPattern pattern() const;
};
void describe(core::Fields& fields, HexagonalNetScene& net);

/// `ring_net:` interlocked rings, each with four neighbours.
struct RingNetScene {
  PanelScene panel;
  double inner_diameter = 0;  ///< m
  double wire_diameter = 0;   ///< m
  std::int64_t windings = 0;

  RingPattern pattern() const;
};
void describe(core::Fields& fields, RingNetScene& net);

/// @pre the scene was read without complaints
/// @throws core::ConfigError if no wire is inside the panel
Net generate(const RhombicNetScene& net);
Net generate(const HexagonalNetScene& net);
Net generate(const RingNetScene& net);
/// Its rings as the polygons through the points where they touch, for rings as elements.
Net generate_polygons(const RingNetScene& net);

/// The repeating pattern of a net, whatever its panel.
Lattice lattice(const SquareNetScene& net);
Lattice lattice(const RhombicNetScene& net);
Lattice lattice(const HexagonalNetScene& net);
Lattice lattice(const RingNetScene& net);

/// A choice of nets and of what else a section allows, for Fields::one_of together with net_alternatives().
template <class... Others>
using NetChoice = std::variant<SquareNetScene, RhombicNetScene, HexagonalNetScene, RingNetScene, Others...>;
std::vector<core::Fields::Alternative> net_alternatives(
    const std::vector<core::Fields::Alternative>& others = {});

}  // namespace talus::mesh
