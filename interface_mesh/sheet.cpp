#include "interface_mesh/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "interface_mesh/points.hpp"
#include "interface_mesh/square_net.hpp"
#include "interface_mesh/triangulation.hpp"

namespace talus::mesh {

namespace {

/// Inner points keep this distance from the outline, in element sizes: closer ones make flat triangles there.
constexpr double distance_from_outline = 0.6;
constexpr int smoothing_rounds = 8;

Index divisions(double length, double size) {
  return std::max<Index>(1, static_cast<Index>(std::lround(length / size)));
}

bool is_divided_in_rows(const Sheet& sheet) {
  return sheet.panel.edge_names.front() == "edge_south" && sheet.edge_spacing == 0 &&
         sheet.edge_nodes.empty();
}

/// The nodes and node sets of a rectangle's cells, without cells yet.
Net grid(const Sheet& sheet, std::array<Index, 2> cells) {
  const Vector2 size = sheet.panel.outline[2];
  Net net = generate(SquareNet{.corner = sheet.panel.origin,
                               .along = sheet.panel.along,
                               .across = sheet.panel.across,
                               .lengths = {size.x(), size.y()},
                               .openings = cells});
  net.surface.segments.clear();
  return net;
}

Net crossed(const Sheet& sheet) {
  const auto [columns, rows] = sheet.crossed_cells;
  Net net = grid(sheet, sheet.crossed_cells);
  const Vector2 size = sheet.panel.outline[2];
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) {
      const Index a = j * (columns + 1) + i, b = a + 1, c = b + columns + 1, d = c - 1;
      const Index centre = net.surface.node_count();
      append(net.surface.positions,
             sheet.panel.place({size.x() * (i + 0.5) / columns, size.y() * (j + 0.5) / rows}));
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, d), std::pair(d, a)})
        net.surface.triangles.push_back({from, to, centre});
    }
  auto& all = std::ranges::find(net.node_sets, "nodes", &NodeSet::name)->nodes;
  all.resize(static_cast<std::size_t>(net.surface.node_count()));
  std::iota(all.begin(), all.end(), 0);
  return net;
}

Net divided_in_rows(const Sheet& sheet) {
  const Vector2 size = sheet.panel.outline[2];
  const std::array openings{divisions(size.x(), sheet.element_size), divisions(size.y(), sheet.element_size)};
  Net net = grid(sheet, openings);
  const Index row = openings[0] + 1;
  for (Index j = 0; j < openings[1]; ++j)
    for (Index i = 0; i < openings[0]; ++i) {
      const Index a = j * row + i, b = a + 1, c = b + row, d = a + row;
      if ((i + j) % 2 == 0)
        net.surface.triangles.insert(net.surface.triangles.end(), {{a, b, c}, {a, c, d}});
      else
        net.surface.triangles.insert(net.surface.triangles.end(), {{a, b, d}, {b, c, d}});
    }
  return net;
}

/// Corners, prescribed nodes and evenly spaced ones between them, counter-clockwise.
std::vector<OutlinePoint> outline_nodes(const Sheet& sheet) {
  const Polygon& outline = sheet.panel.outline;
  std::vector<OutlinePoint> fixed;
  for (std::size_t edge = 0; edge < outline.size(); ++edge)
    fixed.push_back({.edge = edge, .at = outline[edge]});
  for (const auto& node : sheet.edge_nodes) fixed.push_back(closest_on_outline(outline, node));
  std::sort(fixed.begin(), fixed.end(), [](const OutlinePoint& a, const OutlinePoint& b) {
    return std::tie(a.edge, a.share) < std::tie(b.edge, b.share);
  });
  const double spacing = sheet.edge_spacing > 0 ? sheet.edge_spacing : sheet.element_size;
  std::vector<OutlinePoint> nodes;
  for (std::size_t k = 0; k < fixed.size(); ++k) {
    const OutlinePoint& from = fixed[k];
    const Vector2 to = fixed[(k + 1) % fixed.size()].at;
    const double edge_length = (outline[(from.edge + 1) % outline.size()] - outline[from.edge]).norm();
    const double length = (to - from.at).norm();
    if (length <= 1e-9 * edge_length) continue;  // a prescribed node on a corner
    const Index parts = divisions(length, spacing);
    for (Index i = 0; i < parts; ++i) {
      const double share = double(i) / parts;
      nodes.push_back(
          {from.edge, from.share + share * length / edge_length, from.at + share * (to - from.at), 0});
    }
  }
  return nodes;
}

/// Points of a lattice of equilateral triangles, row by row, that keep their distance from the outline.
Polygon inner_points(const Polygon& outline, double size) {
  Vector2 low = outline.front(), high = low;
  for (const auto& corner : outline) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  Polygon points;
  const double row_height = size * std::sqrt(0.75);
  for (int row = 0; low.y() + row * row_height < high.y(); ++row)
    for (double x = low.x() + (row % 2) * size / 2; x < high.x(); x += size) {
      const Vector2 point(x, low.y() + row * row_height);
      if (contains(outline, point) &&
          closest_on_outline(outline, point).distance > distance_from_outline * size)
        points.push_back(point);
    }
  return points;
}

}  // namespace

Net generate(const Sheet& sheet) {
  Net net;
  if (sheet.crossed_cells[0] > 0) {
    net = crossed(sheet);
  } else if (is_divided_in_rows(sheet)) {
    net = divided_in_rows(sheet);
  } else {
    const auto edge = outline_nodes(sheet);
    Polygon outline;
    std::vector<RimNode> rim;
    for (const auto& node : edge) {
      rim.push_back({static_cast<Index>(outline.size()), node.edge, node.share});
      outline.push_back(node.at);
    }
    Triangulation triangulation(outline);
    for (const auto& point : inner_points(sheet.panel.outline, sheet.element_size)) triangulation.add(point);
    triangulation.smooth(smoothing_rounds);
    for (const auto& point : triangulation.points()) append(net.surface.positions, sheet.panel.place(point));
    net.surface.triangles = triangulation.triangles();
    net.node_sets = rim_sets(sheet.panel, std::move(rim), net.surface.node_count());
  }
  net.surface.parts = {{.name = "sheet", .triangle_end = static_cast<Index>(net.surface.triangles.size())}};
  return net;
}

}  // namespace talus::mesh
