#pragma once

#include <array>
#include <vector>

#include "core/vector3.hpp"
#include "dem_solver/rocks/side_of_line.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::dem {

/// A regular grid of points over a surface's box, about its middle.
struct PointGrid {
  core::Vector3 centre = core::Vector3::Zero();  ///< m
  double spacing = 0;                            ///< m
  std::array<int, 3> steps{};                    ///< one less than points along each axis

  core::Vector3 point(int i, int j, int k) const {
    return centre + spacing * core::Vector3(i - 0.5 * steps[0], j - 0.5 * steps[1], k - 0.5 * steps[2]);
  }
  /// The grid's own coordinate along an axis.
  double along(int axis, double x) const { return (x - centre[axis]) / spacing + 0.5 * steps[axis]; }
  double points() const { return (steps[0] + 1.0) * (steps[1] + 1.0) * (steps[2] + 1.0); }
};
/// Covers the surface's box; the number of points does not depend on the unit of length.
PointGrid grid_over(const mesh::Surface& surface, double spacing);

/// Where the lines of a grid along z pass through a closed surface. A line that meets an edge or a corner
/// counts it as if it passed beside it by an infinitely small step, so that every line enters as often as it
/// leaves.
class InnerColumns {
 public:
  InnerColumns(const mesh::Surface& surface, const PointGrid& grid);

  /// Whether a point of height z (m) in a column is inside. Points on the surface may be either.
  bool contains(int i, int j, double z) const;

 private:
  void add(const std::array<core::Vector3, 3>& corners);

  const PointGrid& grid_;
  std::vector<std::vector<double>> heights_;  ///< m; of each column, sorted
};

/// The height (m) at which the line along z through a place passes through a triangle, in `height`; false
/// where it passes beside it.
bool passes_through(const Place& line, const std::array<core::Vector3, 3>& corners, double& height) noexcept;

}  // namespace talus::dem
