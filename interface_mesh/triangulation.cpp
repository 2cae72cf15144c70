#include "interface_mesh/triangulation.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "core/errors.hpp"

namespace talus::mesh {

namespace {

/// Differences below this part of their terms are round-off: lattice points lie on common circles and lines.
constexpr double circle_round_off = 1e-10;

/// The next and the one after next of three.
constexpr std::size_t next(std::size_t i) {
  return (i + 1) % 3;
}
constexpr std::size_t last(std::size_t i) {
  return (i + 2) % 3;
}

/// Whether d is inside the circle through a, b, c, which run counter-clockwise:
///     | ax ay ax^2+ay^2 |
///     | bx by bx^2+by^2 | > 0,  a, b, c relative to d   (L. Guibas, J. Stolfi, Primitives for Voronoi
///     diagrams, 1985) | cx cy cx^2+cy^2 |
bool is_in_circle(const std::array<Vector2, 3>& corners, const Vector2& d) {
  const Vector2 a = corners[0] - d, b = corners[1] - d, c = corners[2] - d;
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), cc = c.squaredNorm();
  const double determinant = aa * (b.x() * c.y() - c.x() * b.y()) + bb * (c.x() * a.y() - a.x() * c.y()) +
                             cc * (a.x() * b.y() - b.x() * a.y());
  return determinant > circle_round_off * (aa + bb + cc) * (aa + bb + cc);
}

bool is_straight(const Vector2& a, const Vector2& b, const Vector2& c) {
  return std::abs(turn(a, b, c)) <= circle_round_off * ((b - a).squaredNorm() + (c - a).squaredNorm());
}

/// Whether corner b of the remaining outline can be cut off: convex, and no other corner in or on the
/// triangle.
bool is_ear(const Polygon& points, const std::vector<Index>& remaining, std::size_t b) {
  const auto at = [&](std::size_t k) {
    return points[static_cast<std::size_t>(remaining[k % remaining.size()])];
  };
  const std::size_t a = (b + remaining.size() - 1) % remaining.size(), c = (b + 1) % remaining.size();
  const Vector2 pa = at(a), pb = at(b), pc = at(c);
  if (turn(pa, pb, pc) <= 0 || is_straight(pa, pb, pc)) return false;
  for (std::size_t k = 0; k < remaining.size(); ++k) {
    if (k == a || k == b || k == c) continue;
    const Vector2 other = at(k);
    const bool behind_cut = turn(pa, pc, other) > 0 && !is_straight(pa, pc, other);
    if (!behind_cut && turn(pa, pb, other) >= 0 && turn(pb, pc, other) >= 0) return false;
  }
  return true;
}

std::vector<std::array<Index, 3>> cut_ears(const Polygon& points) {
  std::vector<Index> remaining(points.size());
  std::iota(remaining.begin(), remaining.end(), Index{0});
  std::vector<std::array<Index, 3>> triangles;
  std::size_t candidate = 0, refused = 0;
  while (remaining.size() > 3) {
    const std::size_t count = remaining.size();
    candidate %= count;
    if (!is_ear(points, remaining, candidate)) {
      if (++refused > count)
        throw core::ConfigError("the outline cannot be triangulated: it crosses or nearly touches itself");
      ++candidate;
      continue;
    }
    triangles.push_back({remaining[(candidate + count - 1) % count], remaining[candidate],
                         remaining[(candidate + 1) % count]});
    remaining.erase(remaining.begin() + static_cast<std::ptrdiff_t>(candidate));
    refused = 0;
  }
  triangles.push_back({remaining[0], remaining[1], remaining[2]});
  return triangles;
}

}  // namespace

Triangulation::Triangulation(const Polygon& outline) : outline_points_(outline.size()), points_(outline) {
  for (const auto& corners : cut_ears(outline)) triangles_.push_back({corners, {outside, outside, outside}});
  link_neighbours();
  std::vector<Index> all(triangles_.size());
  std::iota(all.begin(), all.end(), Index{0});
  flip_around(std::move(all));
}

void Triangulation::link_neighbours() {
  std::map<std::pair<Index, Index>, Index> by_edge;
  for (Index t = 0; t < static_cast<Index>(triangles_.size()); ++t)
    for (std::size_t i = 0; i < 3; ++i) by_edge[{at(t).points[next(i)], at(t).points[last(i)]}] = t;
  for (auto& triangle : triangles_)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto across = by_edge.find({triangle.points[last(i)], triangle.points[next(i)]});
      triangle.neighbours[i] = across == by_edge.end() ? outside : across->second;
    }
}

void Triangulation::relink(Index triangle, Index old_neighbour, Index new_neighbour) {
  if (triangle == outside) return;
  auto& neighbours = at(triangle).neighbours;
  *std::find(neighbours.begin(), neighbours.end(), old_neighbour) = new_neighbour;
}

Index Triangulation::locate(const Vector2& p) const {
  const auto seen_from_outside = [&](const Triangle& triangle) {
    for (std::size_t i = 0; i < 3; ++i)
      if (turn(point(triangle.points[next(i)]), point(triangle.points[last(i)]), p) < 0) return i;
    return std::size_t{3};
  };
  // Walk towards the point; where the outline is in the way, look at all.
  Index current = static_cast<Index>(triangles_.size()) - 1;
  for (std::size_t steps = 0; steps < triangles_.size() && current != outside; ++steps) {
    const std::size_t edge = seen_from_outside(at(current));
    if (edge == 3) return current;
    current = at(current).neighbours[edge];
  }
  for (Index t = 0; t < static_cast<Index>(triangles_.size()); ++t)
    if (seen_from_outside(at(t)) == 3) return t;
  throw core::UsageError("a point to be added to a triangulation is outside its outline");
}

void Triangulation::add(const Vector2& p) {
  const Index found = locate(p);
  const auto index = static_cast<Index>(points_.size());
  points_.push_back(p);
  const auto count = static_cast<Index>(triangles_.size());
  std::size_t on_edge = 3;
  for (std::size_t i = 0; i < 3; ++i)
    if (is_straight(point(at(found).points[next(i)]), point(at(found).points[last(i)]), p)) on_edge = i;
  if (on_edge == 3) {
    split_triangle(found, index);
    flip_around({found, count, count + 1});
  } else {
    const Index across = at(found).neighbours[on_edge];
    if (across == outside) throw core::UsageError("a point to be added to a triangulation is on its outline");
    split_edge(found, on_edge, index);
    flip_around({found, across, count, count + 1});
  }
}

void Triangulation::split_triangle(Index t, Index p) {
  const auto [a, b, c] = at(t).points;
  const auto [beyond_bc, beyond_ca, beyond_ab] = at(t).neighbours;
  const auto second = static_cast<Index>(triangles_.size()), third = second + 1;
  at(t) = {{a, b, p}, {second, third, beyond_ab}};
  triangles_.push_back({{b, c, p}, {third, t, beyond_bc}});
  triangles_.push_back({{c, a, p}, {t, second, beyond_ca}});
  relink(beyond_bc, t, second);
  relink(beyond_ca, t, third);
}

void Triangulation::split_edge(Index t, std::size_t i, Index p) {
  const Triangle here = at(t);
  const Index n = here.neighbours[i];
  const Triangle there = at(n);
  const auto j = static_cast<std::size_t>(std::find(there.neighbours.begin(), there.neighbours.end(), t) -
                                          there.neighbours.begin());
  const Index a = here.points[i], b = here.points[next(i)], c = here.points[last(i)], d = there.points[j];
  const Index beyond_ca = here.neighbours[next(i)], beyond_ab = here.neighbours[last(i)];
  const Index beyond_bd = there.neighbours[next(j)], beyond_dc = there.neighbours[last(j)];
  const auto new_here = static_cast<Index>(triangles_.size()), new_there = new_here + 1;
  at(t) = {{a, b, p}, {new_there, new_here, beyond_ab}};
  at(n) = {{d, c, p}, {new_here, new_there, beyond_dc}};
  triangles_.push_back({{a, p, c}, {n, beyond_ca, t}});
  triangles_.push_back({{d, p, b}, {t, beyond_bd, n}});
  relink(beyond_ca, t, new_here);
  relink(beyond_bd, n, new_there);
}

bool Triangulation::flip_if_better(Index t, std::size_t i) {
  const Triangle here = at(t);
  const Index n = here.neighbours[i];
  if (n == outside) return false;
  const Triangle there = at(n);
  const auto j = static_cast<std::size_t>(std::find(there.neighbours.begin(), there.neighbours.end(), t) -
                                          there.neighbours.begin());
  const Index a = here.points[i], b = here.points[next(i)], c = here.points[last(i)], d = there.points[j];
  if (!is_in_circle({point(a), point(b), point(c)}, point(d))) return false;
  const Index beyond_ca = here.neighbours[next(i)], beyond_ab = here.neighbours[last(i)];
  const Index beyond_bd = there.neighbours[next(j)], beyond_dc = there.neighbours[last(j)];
  at(t) = {{a, b, d}, {beyond_bd, n, beyond_ab}};
  at(n) = {{a, d, c}, {beyond_dc, beyond_ca, t}};
  relink(beyond_bd, n, t);
  relink(beyond_ca, t, n);
  return true;
}

void Triangulation::flip_around(std::vector<Index> waiting) {
  while (!waiting.empty()) {
    const Index t = waiting.back();
    waiting.pop_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const Index n = at(t).neighbours[i];
      if (!flip_if_better(t, i)) continue;
      waiting.push_back(n);
      waiting.push_back(t);
      break;
    }
  }
}

void Triangulation::smooth(int rounds) {
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::vector<Index>> around(points_.size());
    for (Index t = 0; t < static_cast<Index>(triangles_.size()); ++t)
      for (const Index p : at(t).points) around[static_cast<std::size_t>(p)].push_back(t);
    for (std::size_t p = outline_points_; p < points_.size(); ++p) {
      Vector2 sum = Vector2::Zero();
      for (const Index t : around[p])
        for (const Index corner : at(t).points)
          if (corner != static_cast<Index>(p)) sum += point(corner);
      const Vector2 before = points_[p];
      points_[p] = sum / double(2 * around[p].size());
      const bool turned = std::any_of(around[p].begin(), around[p].end(), [&](Index t) {
        const Vector2 &a = point(at(t).points[0]), &b = point(at(t).points[1]), &c = point(at(t).points[2]);
        return turn(a, b, c) <= 0 || is_straight(a, b, c);
      });
      if (turned) points_[p] = before;
    }
    std::vector<Index> all(triangles_.size());
    std::iota(all.begin(), all.end(), Index{0});
    flip_around(std::move(all));
  }
}

std::vector<std::array<Index, 3>> Triangulation::triangles() const {
  std::vector<std::array<Index, 3>> result;
  for (const auto& triangle : triangles_) result.push_back(triangle.points);
  return result;
}

}  // namespace talus::mesh
