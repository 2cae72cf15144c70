#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "dem_solver/particles/row.hpp"

namespace talus::dem {

/// A box of equal cells over a set of points. Points outside fall into the cells at its rim, so a stray
/// particle neither enlarges the grid nor is lost: clamping never puts two points further apart in cells than
/// they are.
class CellGrid {
 public:
  using Cell = std::array<Index, 3>;

  CellGrid() = default;
  /// @param smallest_cell m; cells are larger where the points are so thin that there would be more than
  /// about 2 a point.
  CellGrid(std::span<const Row> points, double smallest_cell);

  TALUS_INLINE Cell cell(const Row& p) const noexcept {
    return {clamped(p.x, 0), clamped(p.y, 1), clamped(p.z, 2)};
  }
  /// Cells are numbered with the longest axis slowest, so that equal numbers along it are a slab.
  TALUS_INLINE Index number(const Cell& c) const noexcept {
    return (c[axis_[0]] * count_[axis_[1]] + c[axis_[1]]) * count_[axis_[2]] + c[axis_[2]];
  }
  /// Another numbering, for sorting: neighbouring slabs, from `first` on, are a block, whose cells are
  /// numbered with the second axis slowest. So neighbours stand near each other in memory, in whichever slab
  /// of the block.
  struct SlabBlock {
    Index first = 0, slabs = 0;
  };
  Index number_in_block(const Cell& c, const SlabBlock& block) const noexcept {
    const Index before = block.first * count_[axis_[1]];
    return (before + c[axis_[1]] * block.slabs + c[axis_[0]] - block.first) * count_[axis_[2]] + c[axis_[2]];
  }
  Index cells_a_slab() const noexcept { return count_[axis_[1]] * count_[axis_[2]]; }
  Index slab(const Cell& c) const noexcept { return c[axis_[0]]; }
  Index slab_count() const noexcept { return count_[axis_[0]]; }
  Index cell_count() const noexcept { return count_[0] * count_[1] * count_[2]; }
  const Cell& counts() const noexcept { return count_; }
  const std::array<int, 3>& axes() const noexcept { return axis_; }

 private:
  TALUS_INLINE Index clamped(double x, int k) const noexcept {
    const double c = (x - low_[k]) * inverse_cell_;
    return c <= 0 ? 0 : c >= last_[k] ? count_[k] - 1 : static_cast<Index>(c);
  }

  std::array<double, 3> low_{};
  std::array<double, 3> last_{};  ///< count - 1
  Cell count_{1, 1, 1};
  std::array<int, 3> axis_{0, 1, 2};  ///< longest first
  double inverse_cell_ = 1;
};

/// The points of each cell of a grid, in the order of their index.
struct CellMembers {
  std::vector<Index> first;   ///< where a cell's points begin; one more than cells
  std::vector<Index> points;  ///< indices, cell after cell

  /// @param cell_of the cell's number of each entry of `members`.
  void fill(std::span<const Index> members, std::span<const Index> cell_of, Index cells);
  std::span<const Index> in(Index cell) const noexcept {
    return {points.data() + first[cell], points.data() + first[cell + 1]};
  }
};

}  // namespace talus::dem
