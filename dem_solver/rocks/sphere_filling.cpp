#include "dem_solver/rocks/sphere_filling.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/errors.hpp"
#include "dem_solver/boundary/closest_point.hpp"

namespace talus::dem {

namespace {

Triple<double> corner(const mesh::Surface& surface, mesh::Index i) {
  return {surface.positions[3 * i], surface.positions[3 * i + 1], surface.positions[3 * i + 2]};
}

/// How far inside a closed surface a point lies: the distance to the nearest triangle, negative outside.
double depth(const mesh::Surface& surface, const core::Vector3& point) {
  const Triple<double> p{point.x(), point.y(), point.z()};
  double nearest = std::numeric_limits<double>::infinity(), solid_angle = 0;
  for (const auto& [ia, ib, ic] : surface.triangles) {
    const Triple<double> a = corner(surface, ia), b = corner(surface, ib), c = corner(surface, ic);
    const Weights w = closest_on_triangle(p, a, b, c);
    nearest = std::min(nearest, length(w.a * (a - p) + w.b * (b - p) + w.c * (c - p)));
    // The solid angle of a triangle (van Oosterom and Strackee 1983); they add up to 4 pi inside and 0
    // outside.
    const Triple<double> u = a - p, v = b - p, t = c - p;
    const double lu = length(u), lv = length(v), lt = length(t);
    const double bottom = lu * lv * lt + dot(u, v) * lt + dot(v, t) * lu + dot(t, u) * lv;
    solid_angle += 2 * std::atan2(dot(u, cross(v, t)), bottom);
  }
  return solid_angle > 2 * std::numbers::pi ? nearest : -nearest;
}

struct Candidate {
  core::Vector3 point;
  double depth;
};

std::vector<Candidate> inner_points(const mesh::Surface& surface, double deviation) {
  Eigen::AlignedBox3d box;
  for (mesh::Index i = 0; i < surface.node_count(); ++i) box.extend(core::Vector3(&surface.positions[3 * i]));
  // A grid finer than this many points an edge costs minutes and gains nothing that a contact would feel.
  constexpr double most_points_along = 64;
  const double spacing = std::max(0.5 * deviation, box.sizes().maxCoeff() / most_points_along);
  std::vector<Candidate> points;
  const auto steps = [&](int k) { return static_cast<int>(std::ceil(box.sizes()[k] / spacing)); };
  for (int i = 0; i <= steps(0); ++i)
    for (int j = 0; j <= steps(1); ++j)
      for (int k = 0; k <= steps(2); ++k) {
        const core::Vector3 p = box.center() + spacing * core::Vector3(i - 0.5 * steps(0), j - 0.5 * steps(1),
                                                                       k - 0.5 * steps(2));
        if (const double d = depth(surface, p); d >= deviation) points.push_back({p, d});
      }
  std::ranges::stable_sort(points, std::greater{}, &Candidate::depth);
  return points;
}

double gap(const std::vector<Ball>& balls, const core::Vector3& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Ball& ball : balls) nearest = std::min(nearest, (point - ball.centre).norm() - ball.radius);
  return nearest;
}

}  // namespace

SphereFilling fill_with_spheres(const mesh::Surface& surface, const FillingGoal& goal) {
  SphereFilling filling;
  for (const Candidate& candidate : inner_points(surface, goal.deviation)) {
    // A point counts as filled when the sphere around it would not stand out from the others by the
    // deviation.
    if (!filling.balls.empty() && gap(filling.balls, candidate.point) + candidate.depth < goal.deviation)
      continue;
    filling.balls.push_back({candidate.point, candidate.depth});
    if (filling.balls.size() > goal.most_balls)
      throw core::ConfigError("filling the rock to a deviation of " + std::to_string(goal.deviation) +
                              " m takes more than " + std::to_string(goal.most_balls) + " spheres");
  }
  if (filling.balls.empty())
    throw core::ConfigError("no sphere fits into the rock: the deviation is larger than half its thickness");
  for (mesh::Index i = 0; i < surface.node_count(); ++i)
    filling.deviation =
        std::max(filling.deviation, gap(filling.balls, core::Vector3(&surface.positions[3 * i])));
  return filling;
}

}  // namespace talus::dem
