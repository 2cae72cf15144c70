#include "dem_solver/boundary/feature_grid.hpp"

#include <algorithm>

namespace talus::dem {

namespace {

Row minimum(const Row& a, const Row& b) {
  return Row{{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z), 0}};
}
Row maximum(const Row& a, const Row& b) {
  return Row{{std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z), 0}};
}
Row moved(const Row& a, double by) {
  return Row{{a.x + by, a.y + by, a.z + by, 0}};
}

/// Calls visit(cell) for all cells between those of two corners.
template <class Visit>
void visit_cells(const CellGrid& grid, const Row& low, const Row& high, Visit&& visit) {
  const CellGrid::Cell first = grid.cell(low), last = grid.cell(high);
  CellGrid::Cell cell{};
  for (cell[0] = first[0]; cell[0] <= last[0]; ++cell[0])
    for (cell[1] = first[1]; cell[1] <= last[1]; ++cell[1])
      for (cell[2] = first[2]; cell[2] <= last[2]; ++cell[2]) visit(grid.number(cell));
}

}  // namespace

void FeatureGrid::build(const Boundary& boundary, double margin) {
  boxes_.clear();
  std::vector<Row> corners;
  double size = 0;
  for (const Feature& f : boundary.features()) {
    const auto corner = [&](int k) { return row(boundary.position(f.nodes[k])); };
    const Row a = corner(0), b = corner(1), c = f.is_segment() ? b : corner(2);
    const Box box{moved(minimum(minimum(a, b), c), -margin - f.wire_radius),
                  moved(maximum(maximum(a, b), c), margin + f.wire_radius)};
    size += std::max({box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z});
    boxes_.push_back(box);
    corners.push_back(box.low);
    corners.push_back(box.high);
  }
  grid_ = CellGrid(corners, size / static_cast<double>(boxes_.size()));
  std::vector<Index> members, cell_of;
  for (std::size_t k = 0; k < boxes_.size(); ++k)
    visit_cells(grid_, boxes_[k].low, boxes_[k].high, [&](Index cell) {
      members.push_back(static_cast<Index>(k));
      cell_of.push_back(cell);
    });
  members_.fill(members, cell_of, grid_.cell_count());
}

void FeatureGrid::near(const Row& point, double reach, std::vector<Index>& found) const {
  found.clear();
  const Row low = moved(point, -reach), high = moved(point, reach);
  visit_cells(grid_, low, high, [&](Index cell) {
    for (Index k : members_.in(cell)) {
      const Box& box = boxes_[k];
      const bool overlaps = low.x <= box.high.x && high.x >= box.low.x && low.y <= box.high.y &&
                            high.y >= box.low.y && low.z <= box.high.z && high.z >= box.low.z;
      if (overlaps) found.push_back(k);
    }
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

}  // namespace talus::dem
