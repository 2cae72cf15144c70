#include "dem_solver/rocks/sphere_filling.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "dem_solver/rocks/inner_grid.hpp"
#include "dem_solver/rocks/triangle_tree.hpp"

namespace talus::dem {

namespace {

/// A length in parts of the deviation, rounded so that what is equal but for round-off is equal.
class Measure {
 public:
  explicit Measure(double deviation) : part_(deviation / parts) {}
  std::int64_t operator()(double length) const { return std::llround(length / part_); }
  static constexpr std::int64_t parts = 1 << 30;  ///< that make the deviation

 private:
  double part_;
};

struct Candidate {
  std::array<int, 3> place;  ///< in the grid
  core::Vector3 point;       ///< m
  double depth;              ///< m; the distance to the surface
  std::int64_t measured_depth;
};

/// The points of a grid that lie deeper than the deviation, deepest first; equal ones in the grid's
/// order.
std::vector<Candidate> inner_points(const mesh::Surface& surface, const PointGrid& grid, double deviation) {
  const TriangleTree tree(surface);
  const InnerColumns columns(surface, grid);
  const Measure measure(deviation);
  std::vector<Candidate> points;
  std::int32_t nearest = 0;  // of the point before, and often of the next one
  for (int i = 0; i <= grid.steps[0]; ++i)
    for (int j = 0; j <= grid.steps[1]; ++j)
      for (int k = 0; k <= grid.steps[2]; ++k) {
        const core::Vector3 p = grid.point(i, j, k);
        if (!columns.contains(i, j, p.z())) continue;
        const double depth = tree.distance({p.x(), p.y(), p.z()}, nearest);
        const std::int64_t measured = measure(depth);
        if (measured > Measure::parts) points.push_back({{i, j, k}, p, depth, measured});
      }
  std::ranges::stable_sort(points, std::greater{}, &Candidate::measured_depth);
  return points;
}

/// Which points still need a sphere.
class Cover {
 public:
  Cover(const std::vector<Candidate>& points, const PointGrid& grid, double deviation)
      : points_(points),
        grid_(grid),
        measure_(deviation),
        covered_(points.size(), 0),
        at_(static_cast<std::size_t>(grid.points()), nothing) {
    for (std::size_t n = 0; n < points.size(); ++n)
      at_[slot(points[n].place[0], points[n].place[1], points[n].place[2])] = static_cast<std::int32_t>(n);
  }

  bool has(std::size_t n) const { return covered_[n] != 0; }

  /// A point is covered when the sphere around it would not stand out from this one by the deviation. It lies
  /// inside of this one then, because it is deeper than the deviation.
  void add(const Ball& ball) {
    const auto range = [&](int axis) {
      return std::pair{
          std::max(0, static_cast<int>(std::floor(grid_.along(axis, ball.centre[axis] - ball.radius)))),
          std::min(grid_.steps[axis],
                   static_cast<int>(std::ceil(grid_.along(axis, ball.centre[axis] + ball.radius))))};
    };
    const auto [first_i, last_i] = range(0);
    const auto [first_j, last_j] = range(1);
    const auto [first_k, last_k] = range(2);
    for (int i = first_i; i <= last_i; ++i)
      for (int j = first_j; j <= last_j; ++j)
        for (int k = first_k; k <= last_k; ++k)
          if (const std::int32_t n = at_[slot(i, j, k)];
              n != nothing && !covered_[n] && covers(ball, points_[n]))
            covered_[n] = 1;
  }

 private:
  bool covers(const Ball& ball, const Candidate& candidate) const {
    return measure_((candidate.point - ball.centre).norm() - ball.radius + candidate.depth) < Measure::parts;
  }
  std::size_t slot(int i, int j, int k) const {
    return (static_cast<std::size_t>(i) * (grid_.steps[1] + 1) + j) * (grid_.steps[2] + 1) + k;
  }

  static constexpr std::int32_t nothing = -1;
  const std::vector<Candidate>& points_;
  const PointGrid& grid_;
  Measure measure_;
  std::vector<char> covered_;
  std::vector<std::int32_t> at_;  ///< the candidate at each point of the grid
};

PointGrid grid_for(const mesh::Surface& surface, double deviation) {
  const PointGrid grid = grid_over(surface, 0.5 * deviation);
  constexpr double most_points = 4e7;
  if (grid.points() > most_points)
    throw core::ConfigError(fmt::format(
        "filling the rock to a deviation of {:.4g} m takes {:.2g} grid points of half that distance, but "
        "{:.0g} are "
        "the most: the deviation must be about {:.2g} m at least",
        deviation, grid.points(), most_points, deviation * std::cbrt(grid.points() / most_points)));
  return grid;
}

}  // namespace

double largest_gap(std::span<const Ball> balls, const mesh::Surface& surface) {
  double largest = 0;
  std::size_t last = 0;  // neighbouring nodes have the same nearest sphere most of the time
  for (mesh::Index i = 0; i < surface.node_count(); ++i) {
    const core::Vector3 node(&surface.positions[3 * i]);
    double gap = (node - balls[last].centre).norm() - balls[last].radius;
    for (std::size_t n = 0; n < balls.size() && gap > largest; ++n)
      if (const double here = (node - balls[n].centre).norm() - balls[n].radius; here < gap) {
        gap = here;
        last = n;
      }
    largest = std::max(largest, gap);
  }
  return largest;
}

SphereFilling fill_with_spheres(const mesh::Surface& surface, const FillingGoal& goal) {
  const PointGrid grid = grid_for(surface, goal.deviation);
  const std::vector<Candidate> points = inner_points(surface, grid, goal.deviation);
  Cover cover(points, grid, goal.deviation);
  SphereFilling filling;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (cover.has(n)) continue;
    filling.balls.push_back({points[n].point, points[n].depth});
    cover.add(filling.balls.back());
    if (filling.balls.size() > goal.most_balls)
      throw core::ConfigError(
          fmt::format("filling the rock to a deviation of {:.4g} m takes more than {} spheres: "
                      "the deviation must be larger",
                      goal.deviation, goal.most_balls));
  }
  if (filling.balls.empty())
    throw core::ConfigError("no sphere fits into the rock: the deviation is larger than half its thickness");
  filling.deviation = largest_gap(filling.balls, surface);
  return filling;
}

}  // namespace talus::dem
