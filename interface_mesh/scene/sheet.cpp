#include "interface_mesh/scene/sheet.hpp"

#include <fmt/format.h>

#include <cmath>

#include "interface_mesh/points.hpp"
#include "interface_mesh/sheet.hpp"

namespace talus::mesh {

namespace {

/// How far a prescribed node may lie off the outline, and how near to another one, in element sizes.
constexpr double off_outline = 1e-6;
constexpr double most_triangles = 2e7;
/// Cells may miss the size by this part of it: units such as 3 ft are not exact.
constexpr double wholeness = 1e-6;

/// In the panel's plane; the third component is the height over it.
core::Vector3 in_panel(const Panel& panel, const core::Vector3& place) {
  const core::Vector3 from_origin = place - panel.origin;
  const core::Vector3 in_plane = panel.place({from_origin.dot(panel.along), from_origin.dot(panel.across)});
  return {from_origin.dot(panel.along), from_origin.dot(panel.across), (place - in_plane).norm()};
}

void check_edge_nodes(core::Fields& fields, const SheetScene& sheet) {
  const Panel panel = make_panel(sheet.panel);
  const double allowed = off_outline * *sheet.element_size;
  for (std::size_t k = 0; k < sheet.edge_nodes.size(); ++k) {
    const core::Vector3 at = in_panel(panel, sheet.edge_nodes[k]);
    const double distance = std::hypot(closest_on_outline(panel.outline, at.head<2>()).distance, at.z());
    fields.rule(distance <= allowed, "edge_nodes",
                fmt::format("must lie on the outline, but {} is {:g} m away from it",
                            describe_point(sheet.edge_nodes[k]), distance));
    for (std::size_t other = 0; other < k; ++other)
      fields.rule((sheet.edge_nodes[k] - sheet.edge_nodes[other]).norm() > allowed, "edge_nodes",
                  fmt::format("names {} twice", describe_point(sheet.edge_nodes[k])));
  }
}

/// How often each cell of a rectangle fits into it; empty where one does not.
std::optional<std::array<Index, 2>> count_cells(const SheetScene& sheet) {
  std::array<Index, 2> count{};
  for (std::size_t k : {0, 1}) {
    const double cells = (*sheet.panel.size)[k] / (*sheet.crossed_cell)[k];
    if (std::abs(cells - std::round(cells)) > wholeness * cells) return {};
    count[k] = static_cast<Index>(std::lround(cells));
  }
  return count;
}

void check_crossed_cell(core::Fields& fields, const SheetScene& sheet) {
  fields.rule(!sheet.element_size && !sheet.edge_spacing && sheet.edge_nodes.empty() && !sheet.panel.outline,
              "crossed_cell", "contradicts element_size, edge_spacing, edge_nodes and outline");
  fields.rule(sheet.crossed_cell->size() == 2, "crossed_cell",
              fmt::format("needs two lengths, but has {}", sheet.crossed_cell->size()));
  if (sheet.crossed_cell->size() != 2 || !sheet.panel.is_complete() || sheet.panel.outline) return;
  fields.rule(count_cells(sheet).has_value(), "crossed_cell", "must divide the size along and across");
}

void check_element_size(core::Fields& fields, const SheetScene& sheet) {
  if (*sheet.element_size <= 0 || !sheet.panel.is_complete()) return;
  const double triangles =
      signed_area(make_panel(sheet.panel).outline) / std::pow(*sheet.element_size, 2) / std::sqrt(3.0 / 16);
  fields.rule(triangles <= most_triangles, "element_size",
              fmt::format("gives about {:.0g} triangles, more than {:.0g}", triangles, most_triangles));
  check_edge_nodes(fields, sheet);
}

}  // namespace

void describe(core::Fields& fields, SheetScene& sheet) {
  describe(fields, sheet.panel);
  fields.optional("element_size", sheet.element_size,
                  {.unit = "m", .range = core::positive, .help = "wanted edge length of the triangles"});
  fields.optional(
      "crossed_cell", sheet.crossed_cell,
      {.unit = "m",
       .range = core::positive,
       .help = "instead: cells of a rectangle, each cut by both diagonals, which should run along the "
               "wires of a chain-link net"});
  fields.optional("edge_spacing", sheet.edge_spacing,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "wanted distance of nodes on the outline; absent: element_size"});
  fields.with_default("edge_nodes", sheet.edge_nodes,
                      {.unit = "m", .help = "places on the outline where nodes must be, such as shackles"});
  fields.rule(sheet.element_size || sheet.crossed_cell, "element_size",
              "needs `element_size` or `crossed_cell`: how large are the triangles?");
  if (sheet.crossed_cell) check_crossed_cell(fields, sheet);
  if (sheet.element_size) check_element_size(fields, sheet);
}

Net generate(const SheetScene& scene) {
  Sheet sheet{.panel = make_panel(scene.panel),
              .element_size = scene.element_size.value_or(0),
              .edge_spacing = scene.edge_spacing.value_or(0),
              .edge_nodes = {},
              .crossed_cells = scene.crossed_cell ? *count_cells(scene) : std::array<Index, 2>{}};
  for (const auto& place : scene.edge_nodes)
    sheet.edge_nodes.push_back(in_panel(sheet.panel, place).head<2>());
  return generate(sheet);
}

}  // namespace talus::mesh
