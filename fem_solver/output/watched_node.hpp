#pragma once

#include <string>

#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// The node that stands for a point a scene names.
struct WatchedNode {
  Index node = 0;
  double distance = 0;  ///< m; from the point, in the reference state
  double reach = 0;     ///< m; length of the longest element at the node
};

/// The nearest node of a part, or of the structure where `part` is null; of several equally near the first.
WatchedNode watched_node(const Model& model, const Part* part, const Vector3& point);

/// "node 220 of net at (1.5, 1.5, 0) m, 75 mm from the point asked for".
std::string description(const Model& model, const WatchedNode& watched);

}  // namespace talus::fem
