#pragma once

#include <vector>

#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// One direction of one node whose motion is given: once, however many supports name it.
struct HeldDirection {
  std::size_t direction = 0;         ///< 3 node + 0, 1, 2
  std::size_t reaction = 0;          ///< its place in arrays of reactions, 3 a node of each support in turn
  const Support* support = nullptr;  ///< whose history leads it
  double displacement = 0;           ///< m; times the history

  double mass(const Model& model) const { return model.node_masses[direction / 3]; }
};

/// The union of all supports, in their order. Where two hold the same direction the first one's reaction has the
/// force. @pre model outlives the list
/// @throws core::ConfigError naming node and direction where two supports ask for different motions
std::vector<HeldDirection> held_directions(const Model& model);

/// Of each node, whether supports hold it in all three directions, one alone or several together: no force moves it.
std::vector<bool> held_nodes(const Model& model);

}  // namespace talus::fem
