#include "dem_solver/scene/grid_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/program/log.hpp"

namespace talus::dem {

namespace {

/// "row 1, column 4 of the file, at (6, 7) m"
std::string place_of(const AsciiGrid& grid, std::size_t height) {
  const std::size_t row = height / static_cast<std::size_t>(grid.columns),
                    column = height % static_cast<std::size_t>(grid.columns);
  const double x = grid.corner.x() + static_cast<double>(column) * grid.column_width,
               y = grid.corner.y() +
                   static_cast<double>(static_cast<std::size_t>(grid.rows) - 1 - row) * grid.row_width;
  return fmt::format("row {}, column {}, at ({:.10g}, {:.10g})", row + 1, column + 1, x, y);
}

std::string declare(double void_value) {
  return fmt::format("if it stands for a missing height, add the header line `NODATA_value {:.9g}`",
                     void_value);
}

/// Voids of other programs, and anything below the deepest trench or above the highest summit.
void check_range(const AsciiGrid& grid, const RefuseHeight& refuse) {
  constexpr double lowest = -11000, highest = 9000, usual_void = -9999;  // m
  for (std::size_t k = 0; k < grid.heights.size(); ++k) {
    const double h = grid.heights[k];
    if (std::isnan(h) || (h >= lowest && h <= highest && h != usual_void)) continue;
    refuse(k, fmt::format("the height {:.9g} in {} is none on Earth in metres; {}", h, place_of(grid, k),
                          declare(h)));
  }
}

/// Mean of |rise|/width between neighbours along rows; 0 where there are none.
double mean_slope(const AsciiGrid& grid) {
  double sum = 0, count = 0;
  for (mesh::Index row = 0; row < grid.rows; ++row)
    for (mesh::Index column = 0; column + 1 < grid.columns; ++column) {
      const double rise = std::abs(grid.height(column + 1, row) - grid.height(column, row));
      if (std::isnan(rise)) continue;
      sum += rise / grid.column_width;
      ++count;
    }
  return count > 0 ? sum / count : 0;
}

/// The corner is a longitude and a latitude, the cells are shorter than a map's, and the heights do not fit them.
void check_degrees(const AsciiGrid& grid, const RefuseHeight& refuse) {
  constexpr double longest_cell = 0.1, steep = 10, tall = 20;
  const double cell = std::max(grid.column_width, grid.row_width);
  const bool on_globe = std::abs(grid.corner.x()) <= 360 && std::abs(grid.corner.y()) <= 90;
  if (!on_globe || cell > longest_cell) return;
  const double extent = std::max(grid.columns * grid.column_width, grid.rows * grid.row_width);
  double largest = 0;
  for (const double h : grid.heights) largest = std::max(largest, std::isnan(h) ? 0 : std::abs(h));
  const double slope = mean_slope(grid);
  if (slope <= steep && largest <= tall * extent) return;
  refuse(0, fmt::format(
                "the map looks like degrees of longitude and latitude: cells of {:.6g} from ({:.8g}, {:.8g}) "
                "with heights up to {:.6g} m and a mean slope of {:.3g}; project it to metres",
                cell, grid.corner.x(), grid.corner.y(), largest, slope));
}

/// The lowest or highest height, and how far it stands from its next.
struct Extreme {
  std::size_t at = 0;  ///< one height that has it
  double value = 0, next = 0;
};

Extreme extreme(const AsciiGrid& grid, double sign) {
  constexpr double none = std::numeric_limits<double>::infinity();
  Extreme found{0, none, none};  // of sign * height, smallest
  for (std::size_t k = 0; k < grid.heights.size(); ++k) {
    const double h = sign * grid.heights[k];
    if (std::isnan(h) || h == found.value) continue;
    if (h < found.value)
      found = {k, h, found.value};
    else
      found.next = std::min(found.next, h);
  }
  return {found.at, sign * found.value, sign * found.next};
}

/// A void of a value that could be a height, such as 0 among heights of 1500 m: one value whose distance to all others
/// is larger than theirs to each other, and a cliff beside every cell that has it.
void check_outliers(const AsciiGrid& grid, const RefuseHeight& refuse) {
  constexpr double cliff = 10, certain = 100;  // rise over width (84 degrees); m
  const double cell = std::max(grid.column_width, grid.row_width);
  const Extreme low = extreme(grid, 1), high = extreme(grid, -1);
  const auto judge = [&](const Extreme& e, double spread) {
    const double gap = std::abs(e.next - e.value);
    if (!std::isfinite(gap) || gap <= spread || gap <= cliff * cell) return;
    const std::string what =
        fmt::format("the height {:.9g} in {} stands {:.6g} m from all others, which are within {:.6g} m; {}",
                    e.value, place_of(grid, e.at), gap, spread, declare(e.value));
    if (gap > certain) refuse(e.at, what);
    core::log_warning(what);
  };
  judge(low, high.value - low.next);
  judge(high, high.next - low.value);
}

}  // namespace

void check_heights(const AsciiGrid& grid, const RefuseHeight& refuse) {
  check_range(grid, refuse);
  check_degrees(grid, refuse);
  check_outliers(grid, refuse);
}

}  // namespace talus::dem
