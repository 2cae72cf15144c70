#include "dem_solver/collision/size_classes.hpp"

#include <algorithm>

namespace talus::dem {

SizeClasses::SizeClasses(const Spheres& spheres, double skin) : skin_(skin) {
  if (spheres.size() == 0) return;
  const auto [smallest, largest] = std::ranges::minmax(spheres.position, {}, &Row::w);
  for (double radius = largest.w; radius > 0.5 * smallest.w; radius *= 0.5)
    classes_.push_back({.largest_radius = radius});
  std::ranges::reverse(classes_);
  for (const Row& p : spheres.position) ++classes_[class_of(p.w)].population;
  std::erase_if(classes_, [](const Class& c) { return c.population == 0; });
  const Class& main = *std::ranges::max_element(classes_, {}, &Class::population);
  main_cell_ = 2 * main.largest_radius + skin_;
}

void SizeClasses::build_cells(const Spheres& spheres) {
  std::vector<std::vector<Index>> members(classes_.size());
  for (Index i = 0; i < spheres.size(); ++i) members[class_of(spheres.position[i].w)].push_back(i);
  for (std::size_t k = 0; k < classes_.size(); ++k) {
    Class& own = classes_[k];
    std::vector<Row> points;
    for (Index i : members[k]) points.push_back(spheres.position[i]);
    own.grid = CellGrid(points, 2 * own.largest_radius + skin_);
    std::vector<Index> cell_of;
    for (const Row& p : points) cell_of.push_back(own.grid.number(own.grid.cell(p)));
    own.members.fill(members[k], cell_of, own.grid.cell_count());
  }
}

}  // namespace talus::dem
