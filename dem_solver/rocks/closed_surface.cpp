#include "dem_solver/rocks/closed_surface.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "dem_solver/rocks/crossing_triangles.hpp"
#include "dem_solver/rocks/inner_grid.hpp"
#include "dem_solver/rocks/surface_nodes.hpp"
#include "dem_solver/rocks/triangle_tree.hpp"

namespace talus::dem {

namespace {

using core::Vector3;

std::string at(const Vector3& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", p.x(), p.y(), p.z());
}

/// An edge of a triangle, from its smaller node on.
struct Edge {
  mesh::Index low, high;
  std::int32_t triangle;
  bool upwards;  ///< the triangle runs along it from low to high
  bool same_nodes(const Edge& other) const { return low == other.low && high == other.high; }
};

std::vector<Edge> sorted_edges(const mesh::Surface& surface) {
  std::vector<Edge> edges;
  edges.reserve(3 * surface.triangles.size());
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const mesh::Index from = surface.triangles[i][k], to = surface.triangles[i][(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), static_cast<std::int32_t>(i), from < to});
    }
  std::ranges::sort(edges, {}, [](const Edge& e) { return std::array{e.low, e.high, e.triangle}; });
  return edges;
}

/// Every edge must belong to two triangles and be run along once in each direction.
std::string edge_fault(const mesh::Surface& surface, const std::vector<Edge>& edges) {
  for (std::size_t k = 0; k < edges.size();) {
    std::size_t end = k + 1;
    while (end < edges.size() && edges[end].same_nodes(edges[k])) ++end;
    const std::size_t count = end - k;
    const auto edge = [&] {
      return fmt::format("the edge from {} to {}", at(node(surface, edges[k].low)),
                         at(node(surface, edges[k].high)));
    };
    if (count == 1) return fmt::format("the surface is not closed: {} belongs to one triangle only", edge());
    if (count > 2)
      return fmt::format("{} belongs to {} triangles: bodies touch there, or the surface has a wall inside",
                         edge(), count);
    if (edges[k].upwards == edges[k + 1].upwards)
      return fmt::format("of the triangles {} and {} at {} one is turned over", edges[k].triangle,
                         edges[k + 1].triangle, edge());
    k = end;
  }
  return {};
}

/// The shells of a closed surface: triangles that hang together by edges.
struct Shells {
  std::vector<std::int32_t> shell_of;  ///< of each triangle
  std::vector<std::int32_t> first;     ///< a triangle of each
  std::vector<std::int64_t> size;      ///< triangles of each

  Shells(std::size_t triangles, const std::vector<Edge>& edges) : shell_of(triangles) {
    std::vector<std::int32_t> root(triangles);
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&root](std::int32_t i) {
      while (root[i] != i) i = root[i] = root[root[i]];
      return i;
    };
    for (std::size_t k = 0; k + 1 < edges.size(); ++k)
      if (edges[k].same_nodes(edges[k + 1])) {
        const std::int32_t a = find(edges[k].triangle), b = find(edges[k + 1].triangle);
        root[std::max(a, b)] = std::min(a, b);
      }
    for (std::size_t i = 0; i < triangles; ++i) {
      const std::int32_t own = find(static_cast<std::int32_t>(i));
      if (own == static_cast<std::int32_t>(i)) {
        shell_of[i] = static_cast<std::int32_t>(first.size());
        first.push_back(own);
        size.push_back(0);
      } else {
        shell_of[i] = shell_of[own];
      }
      ++size[shell_of[i]];
    }
  }
};

std::string crossing(const mesh::Surface& surface, const Shells& shells) {
  std::string found;
  TriangleTree(surface).any_touching([&](std::int32_t i, std::int32_t j) {
    const Face f = face(surface, i), g = face(surface, j);
    if (!cross_each_other(f, g)) return false;
    const char* what =
        shells.shell_of[i] == shells.shell_of[j]
            ? "the surface crosses itself: triangles {} and {} near {}"
            : "the surface is of bodies that reach into each other: triangles {} and {} near {}";
    found = fmt::format(fmt::runtime(what), i, j, at(f.corners[0]));
    return true;
  });
  return found;
}

/// m^3; of each shell, from tetrahedra to a node of the surface: the file's origin may be far away.
std::vector<double> volumes(const mesh::Surface& surface, const std::vector<std::int32_t>& shell_of,
                            std::size_t count) {
  const Vector3 apex = node(surface, surface.triangles.front()[0]);
  std::vector<double> sums(count, 0);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto& [a, b, c] = surface.triangles[i];
    const Vector3 u = node(surface, a) - apex, v = node(surface, b) - apex, w = node(surface, c) - apex;
    sums[shell_of[i]] += u.dot(v.cross(w)) / 6;
  }
  return sums;
}

double volume(const mesh::Surface& surface) {
  return volumes(surface, std::vector<std::int32_t>(surface.triangles.size(), 0), 1).front();
}

bool is_inside(const Vector3& p, const mesh::Surface& surface, const Shells& shells, std::int32_t shell) {
  bool inside = false;
  double height = 0;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    if (shells.shell_of[i] == shell &&
        passes_through({p.x(), p.y()}, face(surface, static_cast<std::int32_t>(i)).corners, height) &&
        height > p.z())
      inside = !inside;
  return inside;
}

/// A rock is one body without a hole inside.
std::string several_shells(const mesh::Surface& surface, const Shells& shells) {
  const std::size_t count = shells.first.size();
  if (count == 1) return {};
  const std::vector<double> volume_of = volumes(surface, shells.shell_of, count);
  const auto main = static_cast<std::int32_t>(
      std::ranges::max_element(volume_of, {}, [](double v) { return std::abs(v); }) - volume_of.begin());
  const auto place = [&](std::int32_t shell) { return face(surface, shells.first[shell]).corners; };
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(count); ++k) {
    const auto corners = place(k);
    if (k != main && is_inside((corners[0] + corners[1] + corners[2]) / 3, surface, shells, main))
      return fmt::format(
          "the surface holds a shell of {} triangles inside, near {}: a rock is solid, so take that shell "
          "out of the file",
          shells.size[k], at(corners[0]));
  }
  const std::int32_t other = main == 0 ? 1 : 0;
  return fmt::format(
      "the surface is {} separate bodies, one of {} triangles near {} and one of {} triangles near {}: a "
      "rock is one "
      "body, so give each a rock of its own (`part` takes one group of a file)",
      count, shells.size[main], at(place(main)[0]), shells.size[other], at(place(other)[0]));
}

}  // namespace

std::string closed_surface_fault(const mesh::Surface& surface) {
  if (surface.triangles.empty()) return "the surface has no triangles";
  const std::vector<Edge> edges = sorted_edges(surface);
  if (std::string fault = edge_fault(surface, edges); !fault.empty()) return fault;
  const Shells shells(surface.triangles.size(), edges);
  if (std::string fault = crossing(surface, shells); !fault.empty()) return fault;
  if (std::string fault = several_shells(surface, shells); !fault.empty()) return fault;
  if (volume(surface) <= 0) return "the surface is turned inside out: its volume is not positive";
  return {};
}

bool turn_outwards(mesh::Surface& surface) {
  if (volume(surface) >= 0) return false;
  for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
  return true;
}

}  // namespace talus::dem
