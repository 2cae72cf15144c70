#include "interface_mesh/near_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>

#include "core/errors.hpp"
#include "interface_mesh/point_tree.hpp"
#include "interface_mesh/points.hpp"

namespace talus::mesh {

using core::Vector3;

namespace {

constexpr double near_of_edge = 1e-3;

using Edge = std::array<Index, 2>;

/// Of all triangles, sorted, each as often as triangles have it.
std::vector<Edge> triangle_edges(const Surface& surface) {
  std::vector<Edge> edges;
  edges.reserve(3 * surface.triangles.size());
  for (const auto& triangle : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      edges.push_back({low, high});
    }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Edges that one triangle alone has, and lines.
std::vector<Edge> rims_and_lines(const Surface& surface) {
  const auto edges = triangle_edges(surface);
  std::vector<Edge> found(surface.segments.begin(), surface.segments.end());
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const bool shared =
        (k > 0 && edges[k - 1] == edges[k]) || (k + 1 < edges.size() && edges[k + 1] == edges[k]);
    if (!shared) found.push_back(edges[k]);
  }
  return found;
}

/// Of the lines and triangles at each node, m.
std::vector<double> shortest_edges(const Surface& surface) {
  std::vector<double> shortest(static_cast<std::size_t>(surface.node_count()),
                               std::numeric_limits<double>::infinity());
  const auto take = [&](Index a, Index b) {
    const double length = (point(surface.positions, a) - point(surface.positions, b)).norm();
    for (const Index node : {a, b}) {
      double& so_far = shortest[static_cast<std::size_t>(node)];
      so_far = std::min(so_far, length);
    }
  };
  for (const auto& [a, b] : surface.segments) take(a, b);
  for (const auto& [a, b, c] : surface.triangles) take(a, b), take(b, c), take(c, a);
  return shortest;
}

/// A node and how far it looks around, m.
struct Seeker {
  Index node = 0;
  double reach = 0;
};

/// Pairs that see each other, both ways. Nodes lie in grids whose cells are as large as what they see, one
/// grid for each factor of two, so that the cost does not depend on how sizes are spread.
class MutualNeighbours {
 public:
  MutualNeighbours(const Surface& surface, const std::vector<Seeker>& seekers)
      : positions_(surface.positions) {
    for (const Seeker& seeker : seekers) {
      const int level = level_of(seeker.reach);
      levels_.insert(level);
      const Vector3 at = point(positions_, seeker.node);
      cells_[{level, cell_of(at.x(), level), cell_of(at.y(), level), cell_of(at.z(), level)}].push_back(
          seeker);
    }
    for (const Seeker& seeker : seekers) look_around(seeker);
    const auto order = [](const NearNodes& a, const NearNodes& b) {
      return std::pair(a.first, a.second) < std::pair(b.first, b.second);
    };
    std::sort(pairs_.begin(), pairs_.end(), order);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end(),
                             [&](const auto& a, const auto& b) { return !order(a, b) && !order(b, a); }),
                 pairs_.end());
  }
  std::vector<NearNodes> take() { return std::move(pairs_); }

 private:
  struct Cell {
    int level;
    double x, y, z;
    bool operator==(const Cell&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Cell& cell) const noexcept {
      std::uint64_t mixed = static_cast<std::uint64_t>(cell.level);
      for (const double each : {cell.x, cell.y, cell.z}) {
        mixed = (mixed ^ std::bit_cast<std::uint64_t>(each + 0.0)) * 0x9E3779B97F4A7C15u;
        mixed ^= mixed >> 32;
      }
      return static_cast<std::size_t>(mixed);
    }
  };

  /// A cell of the level is longer than twice the reach, so that no more than two cells are seen along an
  /// axis; what sees nothing but its own place gets the smallest.
  static int level_of(double reach) {
    return reach > 0 ? std::max(std::ilogb(reach) + 2, smallest) : smallest;
  }
  static double cell_of(double coordinate, int level) { return std::floor(std::ldexp(coordinate, -level)); }

  void look_around(const Seeker& seeker) {
    const Vector3 at = point(positions_, seeker.node);
    // Who sees further has a larger cell; who sees less looks here itself.
    for (auto level = levels_.lower_bound(level_of(seeker.reach)); level != levels_.end(); ++level) {
      const auto cells = [&](double middle) {
        return std::array{cell_of(middle - seeker.reach, *level), cell_of(middle + seeker.reach, *level)};
      };
      for (const double x : cells(at.x()))
        for (const double y : cells(at.y()))
          for (const double z : cells(at.z()))
            if (const auto found = cells_.find({*level, x, y, z}); found != cells_.end())
              for (const Seeker& other : found->second) compare(seeker, other);
    }
  }

  void compare(const Seeker& a, const Seeker& b) {
    if (a.node == b.node) return;
    const double distance = (point(positions_, a.node) - point(positions_, b.node)).norm();
    if (distance <= std::min(a.reach, b.reach))
      pairs_.push_back({std::min(a.node, b.node), std::max(a.node, b.node), distance});
  }

  static constexpr int smallest = -900;
  const std::vector<double>& positions_;
  std::set<int> levels_;
  std::unordered_map<Cell, std::vector<Seeker>, Hash> cells_;
  std::vector<NearNodes> pairs_;
};

/// For every node the first one it is joined with, by way of any others.
std::vector<Index> first_of_joined(Index count, const std::vector<NearNodes>& pairs) {
  std::vector<Index> first(static_cast<std::size_t>(count));
  std::iota(first.begin(), first.end(), Index{0});
  const auto root = [&first](Index node) {
    while (first[static_cast<std::size_t>(node)] != node) {
      Index& next = first[static_cast<std::size_t>(node)];
      node = next = first[static_cast<std::size_t>(next)];
    }
    return node;
  };
  for (const NearNodes& pair : pairs) {
    const Index a = root(pair.first), b = root(pair.second);
    first[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  for (Index node = 0; node < count; ++node) first[static_cast<std::size_t>(node)] = root(node);
  return first;
}

/// Upwards to one digit, for a value to be written into a scene.
double rounded_up(double value) {
  value *= 1.0001;  // what is printed must reach, too
  const double digit = std::pow(10, std::floor(std::log10(value)));
  return std::ceil(value / digit) * digit;
}

}  // namespace

std::vector<NearNodes> nearly_joined(const Surface& surface) {
  const auto shortest = shortest_edges(surface);
  std::vector<Seeker> seekers;
  for (Index node = 0; node < surface.node_count(); ++node)
    if (const double reach = near_of_edge * shortest[static_cast<std::size_t>(node)]; std::isfinite(reach))
      seekers.push_back({node, reach});
  return MutualNeighbours(surface, seekers).take();
}

Net join_near_nodes(const Net& net, double tolerance, const std::string& what) {
  std::vector<Seeker> seekers;
  for (Index node = 0; node < net.surface.node_count(); ++node) seekers.push_back({node, tolerance});
  const auto first = first_of_joined(net.surface.node_count(), MutualNeighbours(net.surface, seekers).take());

  Net joined;
  std::vector<Index> number(first.size());
  for (std::size_t node = 0; node < first.size(); ++node) {
    const bool stays = first[node] == static_cast<Index>(node);
    number[node] = stays ? joined.surface.node_count() : number[static_cast<std::size_t>(first[node])];
    if (stays) append(joined.surface.positions, point(net.surface.positions, static_cast<Index>(node)));
  }
  const auto renumbered = [&](auto cell) {
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const Index a = cell[k], b = cell[(k + 1) % cell.size()];
      if (a != b && first[static_cast<std::size_t>(a)] == first[static_cast<std::size_t>(b)])
        throw core::ConfigError(
            fmt::format("{}: `join` of {:.4g} m would join both ends of an edge, at {} and {}: it must be "
                        "smaller than any edge",
                        what, tolerance, describe_point(point(net.surface.positions, a)),
                        describe_point(point(net.surface.positions, b))));
    }
    for (Index& node : cell) node = number[static_cast<std::size_t>(node)];
    return cell;
  };
  for (const auto& segment : net.surface.segments) joined.surface.segments.push_back(renumbered(segment));
  for (const auto& triangle : net.surface.triangles) joined.surface.triangles.push_back(renumbered(triangle));
  joined.surface.parts = net.surface.parts;
  joined.cell_sets = net.cell_sets;
  for (const NodeSet& set : net.node_sets) {
    NodeSet kept{set.name, {}};
    std::set<Index> seen;
    for (const Index node : set.nodes)
      if (const Index now = number[static_cast<std::size_t>(node)]; seen.insert(now).second)
        kept.nodes.push_back(now);
    joined.node_sets.push_back(std::move(kept));
  }
  return joined;
}

namespace {

void refuse_near_nodes(const Surface& surface, const std::string& what) {
  const auto pairs = nearly_joined(surface);
  if (pairs.empty()) return;
  const auto& worst = *std::max_element(pairs.begin(), pairs.end(),
                                        [](const auto& a, const auto& b) { return a.distance < b.distance; });
  const std::string places = fmt::format("{} pair(s) of nodes", pairs.size());
  const std::string example = fmt::format("nodes {} and {} at {}", worst.first, worst.second,
                                          describe_point(point(surface.positions, worst.first)));
  if (worst.distance == 0)
    throw core::ConfigError(fmt::format(
        "{}: {} are at the same place but not joined, such as {}: the mesh is torn there; `join: 0 m` "
        "joins them",
        what, places, example));
  throw core::ConfigError(
      fmt::format("{}: {} are nearly at the same place but not joined, the furthest apart by {:.4g} m: {}; "
                  "`join: {:g} m` joins "
                  "them, `join: 0 m` leaves them apart",
                  what, places, worst.distance, example, rounded_up(worst.distance)));
}

void refuse_nodes_on_edges(const Surface& surface, const std::string& what) {
  const auto found = nodes_on_edges(surface);
  if (found.empty()) return;
  const auto& [node, edge] = found.front();
  throw core::ConfigError(fmt::format(
      "{}: {} node(s) lie on an edge whose ends they are not, such as node {} at {} on the one from node {} "
      "to node {}: "
      "the mesh is torn there. Divide the edge at the node; `join: 0 m` leaves it as it is",
      what, found.size(), node, describe_point(point(surface.positions, node)), edge[0], edge[1]));
}

}  // namespace

std::vector<NodeOnEdge> nodes_on_edges(const Surface& surface) {
  const std::vector<Edge> edges = rims_and_lines(surface);
  std::vector<Index> nodes;
  for (const Edge& edge : edges) nodes.insert(nodes.end(), edge.begin(), edge.end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const std::vector<double> shortest = shortest_edges(surface);
  std::vector<double> places;
  for (const Index node : nodes) append(places, point(surface.positions, node));
  const PointCloud cloud{places};
  PointTree tree(3, cloud);
  tree.buildIndex();
  std::vector<NodeOnEdge> found;
  std::vector<std::pair<std::size_t, double>> near;
  for (const Edge& edge : edges) {
    const Vector3 start = point(surface.positions, edge[0]),
                  along = point(surface.positions, edge[1]) - start, middle = start + 0.5 * along;
    const double length = along.norm();
    tree.radiusSearch(middle.data(), 0.26 * length * length, near, nanoflann::SearchParams(0, 0.f, false));
    for (const auto& [k, squared] : near) {
      const Index node = nodes[k];
      if (node == edge[0] || node == edge[1]) continue;
      const Vector3 to = point(surface.positions, node) - start;
      const double share = to.dot(along) / (length * length);
      if (share <= near_of_edge || share >= 1 - near_of_edge) continue;  // beside an end: another matter
      if ((to - share * along).norm() <=
          near_of_edge * std::min(length, shortest[static_cast<std::size_t>(node)]))
        found.push_back({node, edge});
    }
  }
  std::ranges::sort(found, {}, [](const NodeOnEdge& each) { return std::pair(each.node, each.edge); });
  return found;
}

void refuse_torn(const Surface& surface, const std::string& what) {
  refuse_near_nodes(surface, what);
  refuse_nodes_on_edges(surface, what);
}

}  // namespace talus::mesh
