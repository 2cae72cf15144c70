#pragma once

#include <array>
#include <span>
#include <vector>

#include "interface_mesh/polygon.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::mesh {

/// A constrained Delaunay triangulation: of all triangulations that keep the outline, the one in which no
/// point sees a triangle's circumcircle from inside; it has the largest smallest angle. Points are added one
/// by one; edges are flipped until the condition holds (C. Lawson, Software for C1 surface interpolation,
/// 1977).
class Triangulation {
 public:
  /// Cuts the ears of an outline (G. Meisters, Polygons have ears, 1975), then flips. Point k is corner k.
  /// @pre find_fault(outline) finds nothing, counter-clockwise. Corners on a straight line are allowed.
  explicit Triangulation(const Polygon& outline);

  /// Adds a point strictly inside the outline, its index is the number of points so far.
  void add(const Vector2& point);
  /// Moves points that are not of the outline towards the middle of their neighbours where that turns no
  /// triangle over, and flips again: evens out the triangles' sizes.
  void smooth(int rounds);

  std::span<const Vector2> points() const { return points_; }
  /// Counter-clockwise.
  std::vector<std::array<Index, 3>> triangles() const;

 private:
  static constexpr Index outside = -1;
  struct Triangle {
    std::array<Index, 3> points{};
    std::array<Index, 3>
        neighbours{};  ///< across the edge opposite of each point; `outside` beyond the outline
  };

  Index locate(const Vector2& point) const;
  void split_triangle(Index triangle, Index point);
  void split_edge(Index triangle, std::size_t opposite, Index point);
  bool flip_if_better(Index triangle, std::size_t opposite);
  void flip_around(std::vector<Index> triangles);
  void link_neighbours();
  void relink(Index triangle, Index old_neighbour, Index new_neighbour);
  Triangle& at(Index triangle) { return triangles_[static_cast<std::size_t>(triangle)]; }
  const Triangle& at(Index triangle) const { return triangles_[static_cast<std::size_t>(triangle)]; }
  const Vector2& point(Index index) const { return points_[static_cast<std::size_t>(index)]; }

  std::size_t outline_points_ = 0;
  std::vector<Vector2> points_;
  std::vector<Triangle> triangles_;
};

}  // namespace talus::mesh
