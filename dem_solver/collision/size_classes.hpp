#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "dem_solver/collision/grid.hpp"
#include "dem_solver/particles/spheres.hpp"

namespace talus::dem {

/// Spheres sorted into classes of radius, each within a factor of two, each with a grid of its own cell size.
class SizeClasses {
 public:
  SizeClasses(const Spheres& spheres, double skin);

  /// The class with the most spheres; its cells sort the spheres in space.
  double main_cell() const noexcept { return main_cell_; }
  /// Sorts the members into cells. Call when the spheres are in their final order.
  void build_cells(const Spheres& spheres);

  /// Calls found(j) for every sphere j that may be within reach of sphere i and that i is to look for: those
  /// of its own class that come after it in the class's cells, and all of the larger classes.
  template <class Found>
  void visit_neighbours(const Row& position, Index i, Found&& found) const {
    const std::size_t own = class_of(position.w);
    visit_own(classes_[own], position, i, found);
    for (std::size_t k = own + 1; k < classes_.size(); ++k) visit_all(classes_[k], position, found);
  }

 private:
  struct Class {
    double largest_radius = 0;  ///< m; upper end of the class
    Index population = 0;
    CellGrid grid{};
    CellMembers members{};
  };

  std::size_t class_of(double radius) const noexcept {
    std::size_t k = 0;
    while (radius > classes_[k].largest_radius) ++k;
    return k;
  }

  template <class Found>
  static void visit_own(const Class& own, const Row& position, Index i, Found&& found) {
    const CellGrid::Cell centre = own.grid.cell(position);
    const Index centre_number = own.grid.number(centre);
    for (Index j : own.members.in(centre_number))
      if (j > i) found(j);
    visit_rows(own.grid, centre, [&](Index first, Index last) {
      for (Index j : members_between(own, std::max(first, centre_number + 1), last)) found(j);
    });
  }

  template <class Found>
  static void visit_all(const Class& other, const Row& position, Found&& found) {
    visit_rows(other.grid, other.grid.cell(position), [&](Index first, Index last) {
      for (Index j : members_between(other, first, last)) found(j);
    });
  }

  /// Members of all cells from one number to another; none where the last comes before the first.
  static std::span<const Index> members_between(const Class& of, Index first, Index last) noexcept {
    const Index begin = of.members.first[first], end = of.members.first[std::max(first, last + 1)];
    return {of.members.points.data() + begin, of.members.points.data() + end};
  }

  /// The 27 cells around a cell, as far as they are in the grid, in the order of their numbers: nine rows of
  /// neighbouring numbers, whose members stand one after the other.
  template <class Visit>
  static void visit_rows(const CellGrid& grid, const CellGrid::Cell& centre, Visit&& visit) {
    const auto [a, b, c] = grid.axes();
    const auto low = [&](int k) { return centre[k] > 0 ? centre[k] - 1 : 0; };
    const auto high = [&](int k) { return centre[k] + 1 < grid.counts()[k] ? centre[k] + 1 : centre[k]; };
    const Index along = high(c) - low(c);
    CellGrid::Cell cell{};
    cell[c] = low(c);
    for (cell[a] = low(a); cell[a] <= high(a); ++cell[a])
      for (cell[b] = low(b); cell[b] <= high(b); ++cell[b]) {
        const Index first = grid.number(cell);
        visit(first, first + along);
      }
  }

  double skin_ = 0;
  double main_cell_ = 1;
  std::vector<Class> classes_;
};

}  // namespace talus::dem
