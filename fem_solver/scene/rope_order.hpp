#pragma once

#include <vector>

#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// Nodes that a rope runs through, of one set.
struct RopeStretch {
  std::vector<Index> nodes;
  bool has_order = true;  ///< false: a box selected them, in whatever order the model has them
};

/// Puts stretches without an order of their own in order along the rope: by how far they lie on the way from the node before to the
/// one after, or along their own longest direction where the rope has nothing else.
void put_in_order(std::vector<RopeStretch>& stretches, const Model& model);

/// m; along the nodes in their order.
double way_along(const std::vector<Index>& nodes, const Model& model);
/// m; from the first node always on to the nearest one that is left: what a rope that does not run to and fro is not much longer than.
double way_to_nearest(const std::vector<Index>& nodes, const Model& model);
/// The first node at which the way turns by more than 100 degrees; -1: nowhere.
Index first_turn_back(const std::vector<Index>& nodes, const Model& model);

}  // namespace talus::fem
