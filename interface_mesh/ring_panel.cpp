#include "interface_mesh/ring_panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/errors.hpp"
#include "interface_mesh/points.hpp"

namespace talus::mesh {
namespace {

constexpr double of_rounding = 1e-9;  // of a ring's diameter

bool is_rectangle(const Panel& panel) {
  return std::ranges::find(panel.edge_names, "edge_south") != panel.edge_names.end();
}

/// Where rings stand: column and row from the lower corner of the outline.
struct RingGrid {
  Vector2 low, distance;
  std::array<Index, 2> count;

  RingGrid(double diameter, const Panel& panel) : low(panel.outline.front()) {
    Vector2 high = low;
    for (const Vector2& corner : panel.outline) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    for (const int axis : {0, 1}) {
      const double extent = (high - low)[axis], rings = extent / diameter;
      const double whole = is_rectangle(panel) ? std::round(rings) : std::floor(rings * (1 + of_rounding));
      count[static_cast<std::size_t>(axis)] = static_cast<Index>(whole);
      distance[axis] = is_rectangle(panel) ? extent / whole : diameter;
    }
  }
  /// Places in half rings: east, north, west, south of a ring.
  static std::array<std::array<Index, 2>, 4> contacts(Index column, Index row) {
    const Index x = 2 * column + 1, y = 2 * row + 1;
    return {{{x + 1, y}, {x, y + 1}, {x - 1, y}, {x, y - 1}}};
  }
  Vector2 place(const std::array<Index, 2>& half) const {
    return low + Vector2(0.5 * half[0] * distance.x(), 0.5 * half[1] * distance.y());
  }
};

bool is_inside(const Panel& panel, const Vector2& at, double diameter) {
  return closest_on_outline(panel.outline, at).distance <= of_rounding * diameter ||
         contains(panel.outline, at);
}

/// The nodes beside each corner: the last one of the edge before it, and the first one of the edge behind it.
void fill_corners(std::vector<NodeSet>& sets) {
  constexpr std::size_t corners = 2, first_edge = 3;  // in the order of rim_sets()
  const std::size_t edges = sets.size() - first_edge;
  for (std::size_t k = 0; k < edges; ++k) {
    const auto &before = sets[first_edge + (k + edges - 1) % edges].nodes,
               &behind = sets[first_edge + k].nodes;
    if (!before.empty()) sets[corners].nodes.push_back(before.back());
    if (!behind.empty()) sets[corners].nodes.push_back(behind.front());
  }
}

}  // namespace

double misfit(double diameter, const Panel& panel) {
  if (!is_rectangle(panel)) return 0;
  return (RingGrid(diameter, panel).distance / diameter - Vector2::Ones()).cwiseAbs().maxCoeff();
}

Net ring_polygons(double diameter, const Panel& panel) {
  const RingGrid grid(diameter, panel);
  Net net;
  std::vector<Vector2> places;
  std::vector<int> rings_at;
  std::map<std::array<Index, 2>, Index> numbers;
  const auto node_at = [&](const std::array<Index, 2>& half) {
    const auto [found, is_new] = numbers.emplace(half, static_cast<Index>(places.size()));
    if (is_new) {
      places.push_back(grid.place(half));
      rings_at.push_back(0);
    }
    ++rings_at[static_cast<std::size_t>(found->second)];
    return found->second;
  };
  for (Index row = 0; row < grid.count[1]; ++row)
    for (Index column = 0; column < grid.count[0]; ++column) {
      const auto contacts = RingGrid::contacts(column, row);
      const bool whole = std::ranges::all_of(
          contacts, [&](const auto& half) { return is_inside(panel, grid.place(half), diameter); });
      if (!whole) continue;
      std::array<Index, 4> nodes;
      std::ranges::transform(contacts, nodes.begin(), node_at);
      for (std::size_t k = 0; k < nodes.size(); ++k)
        net.surface.segments.push_back({nodes[k], nodes[(k + 1) % nodes.size()]});
    }
  if (places.empty())
    throw core::ConfigError("no whole ring is inside the panel: its rings are larger than it");

  std::vector<RimNode> rim;
  for (std::size_t i = 0; i < places.size(); ++i) {
    append(net.surface.positions, panel.place(places[i]));
    if (rings_at[i] > 1) continue;
    const OutlinePoint outline = closest_on_outline(panel.outline, places[i]);
    rim.push_back({static_cast<Index>(i), outline.edge, outline.share});
  }
  net.surface.parts = {{.name = "ring", .segment_end = static_cast<Index>(net.surface.segments.size())}};
  net.node_sets = rim_sets(panel, std::move(rim), net.surface.node_count());
  fill_corners(net.node_sets);
  return net;
}

}  // namespace talus::mesh
