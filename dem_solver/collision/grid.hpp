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
  /// Cells are numbered with the longest axis slowest.
  TALUS_INLINE Index number(const Cell& c) const noexcept {
    return (c[axis_[0]] * count_[axis_[1]] + c[axis_[1]]) * count_[axis_[2]] + c[axis_[2]];
  }
  /// Layers across the longest axis, thinner than cells so that they can be shared out evenly. Points nearer
  /// than a cell are at most `layers_a_cell` layers apart.
  static constexpr Index layers_a_cell = 8;
  Index layer(const Row& p) const noexcept {
    const double l = (component(p, axis_[0]) - low_[axis_[0]]) * inverse_cell_ * layers_a_cell;
    return l <= 0 ? 0 : l >= layer_count() - 1 ? layer_count() - 1 : static_cast<Index>(l);
  }
  Index layer_count() const noexcept { return count_[axis_[0]] * layers_a_cell; }
  /// Neighbouring layers, with a numbering of the cells they cut that is for sorting: the second axis is the
  /// slowest, so that neighbours stand near each other in memory, in whichever layer of the block.
  struct LayerBlock {
    Index first_slab = 0, slabs = 0;  ///< cells along the longest axis
    Index cells_before = 0;           ///< in the blocks before
  };
  LayerBlock block_of_layers(Index begin, Index end, Index cells_before) const noexcept {
    const Index first = begin / layers_a_cell;
    return {first, (end - 1) / layers_a_cell + 1 - first, cells_before};
  }
  Index number_in_block(const Cell& c, const LayerBlock& block) const noexcept {
    const Index column = c[axis_[1]] * block.slabs + c[axis_[0]] - block.first_slab;
    return block.cells_before + column * count_[axis_[2]] + c[axis_[2]];
  }
  Index cells_of(const LayerBlock& block) const noexcept {
    return block.slabs * count_[axis_[1]] * count_[axis_[2]];
  }
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
