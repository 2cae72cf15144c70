#include "dem_solver/rocks/inner_grid.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "dem_solver/rocks/surface_nodes.hpp"

namespace talus::dem {

PointGrid grid_over(const mesh::Surface& surface, double spacing) {
  Eigen::AlignedBox3d box;
  for (mesh::Index i = 0; i < surface.node_count(); ++i) box.extend(node(surface, i));
  PointGrid grid{.centre = box.center(), .spacing = spacing};
  // A whole number of steps must not become one more by the round-off of a unit.
  constexpr double round_off = 1e-9;
  for (int axis = 0; axis < 3; ++axis)
    grid.steps[axis] = static_cast<int>(std::min(1e9, std::ceil(box.sizes()[axis] / spacing - round_off)));
  return grid;
}

bool passes_through(const Place& line, const std::array<core::Vector3, 3>& corners, double& height) noexcept {
  double weights = 0, sum = 0;
  int side = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const core::Vector3 &a = corners[(k + 1) % 3], &b = corners[(k + 2) % 3];
    const Place from{a.x(), a.y()}, to{b.x(), b.y()};
    const int here = side_of_line(from, to, line);
    if (here == 0 || (k > 0 && here != side)) return false;
    side = here;
    // Rounding may give a tiny weight the wrong sign.
    const double weight = std::max(0.0, side * turn(from, to, line));
    weights += weight;
    sum += weight * corners[k].z();
  }
  height = weights > 0 ? sum / weights : (corners[0].z() + corners[1].z() + corners[2].z()) / 3;
  return true;
}

InnerColumns::InnerColumns(const mesh::Surface& surface, const PointGrid& grid)
    : grid_(grid), heights_(static_cast<std::size_t>(grid.steps[0] + 1) * (grid.steps[1] + 1)) {
  for (const auto& [a, b, c] : surface.triangles) add({node(surface, a), node(surface, b), node(surface, c)});
  for (auto& column : heights_) std::ranges::sort(column);
}

void InnerColumns::add(const std::array<core::Vector3, 3>& corners) {
  const auto range = [&](int axis) {
    const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
    return std::pair{std::max(0, static_cast<int>(std::floor(grid_.along(axis, low)))),
                     std::min(grid_.steps[axis], static_cast<int>(std::ceil(grid_.along(axis, high))))};
  };
  const auto [first_i, last_i] = range(0);
  const auto [first_j, last_j] = range(1);
  double height = 0;
  for (int i = first_i; i <= last_i; ++i)
    for (int j = first_j; j <= last_j; ++j) {
      const core::Vector3 p = grid_.point(i, j, 0);
      if (passes_through({p.x(), p.y()}, corners, height))
        heights_[static_cast<std::size_t>(i) * (grid_.steps[1] + 1) + j].push_back(height);
    }
}

bool InnerColumns::contains(int i, int j, double z) const {
  const auto& column = heights_[static_cast<std::size_t>(i) * (grid_.steps[1] + 1) + j];
  return (column.end() - std::ranges::upper_bound(column, z)) % 2 == 1;
}

}  // namespace talus::dem
