#include "interface_mesh/scene/panel.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "interface_mesh/points.hpp"

namespace talus::mesh {

using core::Vector3;

namespace {

/// Corners of an outline may miss their common plane, and the directions of a rectangle a right angle, by
/// this part of their size.
constexpr double exactness = 1e-6;

bool are_perpendicular(const Vector3& a, const Vector3& b) {
  return a.norm() > 0 && b.norm() > 0 && std::abs(a.dot(b)) <= exactness * a.norm() * b.norm();
}

double extent(const std::vector<Vector3>& corners) {
  double largest = 0;
  for (const auto& corner : corners) largest = std::max(largest, (corner - corners.front()).norm());
  return largest;
}

std::string explain(const OutlineFault& fault, const std::vector<Vector3>& corners) {
  using Kind = OutlineFault::Kind;
  const auto corner = [&](std::size_t k) { return describe_point(corners[k % corners.size()]); };
  switch (fault.kind) {
    case Kind::too_few_corners:
      return fmt::format("needs at least 3 corners, but has {}", corners.size());
    case Kind::repeated_corner:
      return fmt::format("has its corners {} and {} at the same place {}", fault.first + 1, fault.second + 1,
                         corner(fault.first));
    case Kind::crossing_edges:
      return fmt::format("crosses or touches itself: edge {} from {} to {} and edge {} from {} to {}",
                         fault.first + 1, corner(fault.first), corner(fault.first + 1), fault.second + 1,
                         corner(fault.second), corner(fault.second + 1));
    case Kind::no_area:
      break;
  }
  return fmt::format("encloses no area around {}", corner(0));
}

void check_outline(core::Fields& fields, const std::vector<Vector3>& corners) {
  if (corners.size() < 3) {
    fields.rule(false, "outline", explain({OutlineFault::Kind::too_few_corners}, corners));
    return;
  }
  const double off_plane = flatness(corners);
  const bool flat = off_plane <= exactness * extent(corners);
  fields.rule(
      flat, "outline",
      fmt::format("must be flat, but its corners are up to {:g} m off their common plane", off_plane));
  if (!flat) return;
  if (const auto fault = find_fault(make_panel(corners).outline))
    fields.rule(false, "outline", explain(*fault, corners));
}

}  // namespace

void describe(core::Fields& fields, PanelScene& panel) {
  fields.optional("corner", panel.corner, {.unit = "m", .help = "the south-west corner of a rectangle"});
  fields.optional("size", panel.size,
                  {.unit = "m", .range = core::positive, .help = "lengths of its south and its west edge"});
  fields.optional("along", panel.along, {.help = "direction of its south edge; absent: [1, 0, 0]"});
  fields.optional("across", panel.across, {.help = "direction of its west edge; absent: [0, 1, 0]"});
  fields.optional(
      "outline", panel.outline,
      {.unit = "m", .help = "corners of any flat outline instead; edge_1 runs from the first to the second"});
  const bool rectangle = panel.corner || panel.size || panel.along || panel.across;
  fields.rule(!(panel.outline && rectangle), "outline",
              "contradicts corner, size, along and across, which make a rectangle");
  fields.rule(panel.outline || (panel.corner && panel.size), panel.corner ? "size" : "corner",
              "needs `corner` and `size`, or `outline`: where is it?");
  fields.rule(!panel.size || panel.size->size() == 2, "size",
              fmt::format("needs two lengths, but has {}", panel.size ? panel.size->size() : 0));
  fields.rule(
      are_perpendicular(panel.along.value_or(Vector3::UnitX()), panel.across.value_or(Vector3::UnitY())),
      panel.across ? "across" : "along", "must make a right angle with the other edge's direction");
  if (panel.outline) check_outline(fields, *panel.outline);
}

Panel make_panel(const PanelScene& panel) {
  if (panel.outline) return make_panel(*panel.outline);
  return make_panel(Rectangle{.corner = *panel.corner,
                              .along = panel.along.value_or(Vector3::UnitX()),
                              .across = panel.across.value_or(Vector3::UnitY()),
                              .length = (*panel.size)[0],
                              .width = (*panel.size)[1]});
}

}  // namespace talus::mesh
