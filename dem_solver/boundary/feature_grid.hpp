#pragma once

#include <span>
#include <vector>

#include "dem_solver/boundary/boundary.hpp"
#include "dem_solver/collision/grid.hpp"

namespace talus::dem {

/// Finds the features of a boundary near a sphere: each feature stands in all cells its box touches.
class FeatureGrid {
 public:
  /// @param margin m; how far the boundary may move until the grid is built again.
  void build(const Boundary& boundary, double margin);

  /// Replaces `found` by the features whose box, as built, comes nearer than `reach` to the point; ascending,
  /// each once.
  void near(const Row& point, double reach, std::vector<Index>& found) const;

 private:
  struct Box {
    Row low, high;
  };
  CellGrid grid_;
  CellMembers members_;
  std::vector<Box> boxes_;
};

}  // namespace talus::dem
