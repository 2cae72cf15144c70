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

/// In the panel's plane; the third component is the height over it.
core::Vector3 in_panel(const Panel& panel, const core::Vector3& place) {
  const core::Vector3 from_origin = place - panel.origin;
  const core::Vector3 in_plane = panel.place({from_origin.dot(panel.along), from_origin.dot(panel.across)});
  return {from_origin.dot(panel.along), from_origin.dot(panel.across), (place - in_plane).norm()};
}

void check_edge_nodes(core::Fields& fields, const SheetScene& sheet) {
  const Panel panel = make_panel(sheet.panel);
  const double allowed = off_outline * sheet.element_size;
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

}  // namespace

void describe(core::Fields& fields, SheetScene& sheet) {
  describe(fields, sheet.panel);
  fields.required("element_size", sheet.element_size,
                  {.unit = "m", .range = core::positive, .help = "wanted edge length of the triangles"});
  fields.optional("edge_spacing", sheet.edge_spacing,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "wanted distance of nodes on the outline; absent: element_size"});
  fields.with_default("edge_nodes", sheet.edge_nodes,
                      {.unit = "m", .help = "places on the outline where nodes must be, such as shackles"});
  if (sheet.element_size <= 0 || !sheet.panel.is_complete()) return;
  const double triangles =
      signed_area(make_panel(sheet.panel).outline) / std::pow(sheet.element_size, 2) / std::sqrt(3.0 / 16);
  fields.rule(triangles <= most_triangles, "element_size",
              fmt::format("gives about {:.0g} triangles, more than {:.0g}", triangles, most_triangles));
  check_edge_nodes(fields, sheet);
}

Net generate(const SheetScene& scene) {
  Sheet sheet{.panel = make_panel(scene.panel),
              .element_size = scene.element_size,
              .edge_spacing = scene.edge_spacing.value_or(0),
              .edge_nodes = {}};
  for (const auto& place : scene.edge_nodes)
    sheet.edge_nodes.push_back(in_panel(sheet.panel, place).head<2>());
  return generate(sheet);
}

}  // namespace talus::mesh
