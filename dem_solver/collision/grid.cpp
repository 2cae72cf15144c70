#include "dem_solver/collision/grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace talus::dem {

namespace {

struct Extent {
  double low = 0, high = 0;
};

constexpr std::size_t sample_size = 2'000;  // enough for a thousandth to be two points

/// The span that holds all but the outermost thousandth of the values on either side, so that strays don't
/// spread the grid.
Extent trimmed_extent(std::vector<double>& values) {
  const std::size_t cut = values.size() / 1000;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(cut);
  std::nth_element(values.begin(), place, values.end());
  const double low = *place;  // now: the next search moves it
  const auto high = values.end() - 1 - static_cast<std::ptrdiff_t>(cut);
  std::nth_element(place, high, values.end());
  return {low, *high};
}

}  // namespace

CellGrid::CellGrid(std::span<const Row> points, double smallest_cell) {
  if (points.empty()) return;
  std::array<Extent, 3> extent;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / sample_size);
  std::vector<double> values;
  for (int k = 0; k < 3; ++k) {
    values.clear();
    for (std::size_t i = 0; i < points.size(); i += stride) values.push_back(component(points[i], k));
    extent[k] = trimmed_extent(values);
    low_[k] = extent[k].low;
  }
  const double most_cells = 2.0 * static_cast<double>(points.size()) + 64;
  double cell = smallest_cell;
  const auto cells_along = [&](int k) { return std::floor((extent[k].high - extent[k].low) / cell) + 1; };
  while (cells_along(0) * cells_along(1) * cells_along(2) > most_cells) cell *= 1.1;
  for (int k = 0; k < 3; ++k) {
    count_[k] = static_cast<Index>(cells_along(k));
    last_[k] = count_[k] - 1;
  }
  inverse_cell_ = 1 / cell;
  std::iota(axis_.begin(), axis_.end(), 0);
  std::ranges::stable_sort(axis_, [this](int a, int b) { return count_[a] > count_[b]; });
}

void CellMembers::fill(std::span<const Index> members, std::span<const Index> cell_of, Index cells) {
  first.assign(static_cast<std::size_t>(cells) + 1, 0);
  for (Index c : cell_of) ++first[c + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  points.resize(members.size());
  std::vector<Index> next(first.begin(), first.end() - 1);
  for (std::size_t k = 0; k < members.size(); ++k) points[next[cell_of[k]]++] = members[k];
}

}  // namespace talus::dem
