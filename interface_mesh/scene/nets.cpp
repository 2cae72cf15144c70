#include "interface_mesh/scene/nets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/scene/plausible.hpp"
#include "interface_mesh/ring_panel.hpp"

namespace talus::mesh {

namespace {

constexpr double most_segments = 2e7;

void describe_wire(core::Fields& fields, double& wire_diameter) {
  fields.required("wire_diameter", wire_diameter,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "diameter of a single wire",
                   .plausible = core::plausible::wire_diameter});
}

void require_two(core::Fields& fields, const std::vector<double>& lengths, const char* key) {
  fields.rule(lengths.size() == 2, key, fmt::format("needs two lengths, but has {}", lengths.size()));
}

/// Refuses nets too large to be meant, before they are made.
void limit_size(core::Fields& fields, const PanelScene& panel, const Lattice& pattern) {
  if (!panel.is_complete()) return;
  const double cells = signed_area(make_panel(panel).outline) / (pattern.cell.x() * pattern.cell.y());
  const double segments = cells * double(pattern.links.size());
  fields.rule(segments <= most_segments, "wire_diameter",
              fmt::format("is that of a net of about {:.0g} segments, more than {:.0g}: are the units right?",
                          segments, most_segments));
}

void require_opening(core::Fields& fields, double opening) {
  fields.rule(opening > 0, "wire_diameter",
              fmt::format("leaves no opening between the wires (it would be {:g} m)", opening));
}

}  // namespace

RhombicPattern RhombicNetScene::pattern() const {
  if (diagonals) return {.diagonals = {(*diagonals)[0], (*diagonals)[1]}, .wire_diameter = wire_diameter};
  // The distance of opposite sides is side x sin(angle); the wires take half a diameter of it on each side.
  const double side = (*opening + wire_diameter) / std::sin(*angle);
  return {.diagonals = {2 * side * std::sin(*angle / 2), 2 * side * std::cos(*angle / 2)},
          .wire_diameter = wire_diameter};
}

void describe(core::Fields& fields, RhombicNetScene& net) {
  describe(fields, net.panel);
  describe_wire(fields, net.wire_diameter);
  fields.optional("diagonals", net.diagonals,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "diagonals of a mesh along and across, between wire axes"});
  fields.optional("opening", net.opening,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "diameter of the largest sphere that passes, instead of diagonals"});
  fields.optional(
      "angle", net.angle,
      {.unit = "rad",
       .range = {.low = 0, .high = std::numbers::pi, .low_included = false, .high_included = false},
       .help = "angle of a mesh at its upper and lower end, with opening"});
  const bool by_opening = net.opening && net.angle;
  fields.rule(net.diagonals.has_value() != by_opening && net.opening.has_value() == net.angle.has_value(),
              "wire_diameter",
              "needs `diagonals`, or `opening` and `angle`, beside it: how large are the meshes?");
  if (net.diagonals) require_two(fields, *net.diagonals, "diagonals");
  if (net.wire_diameter <= 0 || !(net.diagonals ? net.diagonals->size() == 2 : by_opening)) return;
  require_opening(fields, opening(net.pattern()));
  limit_size(fields, net.panel, lattice(net.pattern()));
}

HexagonalPattern HexagonalNetScene::pattern() const {
  return {.mesh_size = {mesh_size[0], mesh_size[1]},
          .twist_length = twist_length,
          .wire_diameter = wire_diameter};
}

void describe(core::Fields& fields, HexagonalNetScene& net) {
  describe(fields, net.panel);
  describe_wire(fields, net.wire_diameter);
  fields.required("mesh_size", net.mesh_size,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "distance of neighbouring twists, and length of an opening along them"});
  fields.required("twist_length", net.twist_length,
                  {.unit = "m", .range = core::positive, .help = "length over which two wires are twisted"});
  require_two(fields, net.mesh_size, "mesh_size");
  if (net.wire_diameter <= 0 || net.mesh_size.size() != 2) return;
  fields.rule(net.twist_length < net.mesh_size[1], "twist_length",
              fmt::format("must be less than the length of an opening, {:g} m", net.mesh_size[1]));
  require_opening(fields, opening(net.pattern()));
  limit_size(fields, net.panel, lattice(net.pattern()));
}

RingPattern RingNetScene::pattern() const {
  return {.inner_diameter = inner_diameter,
          .wire_diameter = wire_diameter,
          .windings = static_cast<int>(windings)};
}

void describe(core::Fields& fields, RingNetScene& net) {
  describe(fields, net.panel);
  describe_wire(fields, net.wire_diameter);
  fields.required("inner_diameter", net.inner_diameter,
                  {.unit = "m", .range = core::positive, .help = "inner diameter of a ring"});
  fields.required("windings", net.windings,
                  {.range = {.low = 1, .high = 100}, .help = "how often the wire goes round a ring"});
  if (net.wire_diameter <= 0 || net.inner_diameter <= 0 || net.windings < 1) return;
  const double bundle = net.pattern().bundle_diameter(),
               thickest = net.inner_diameter * (std::numbers::sqrt2 - 1) / 2;
  fields.rule(bundle < thickest, "windings",
              fmt::format("gives bundles of {:g} m, but from {:g} m on rings touch across the corner", bundle,
                          thickest));
  if (bundle < thickest) limit_size(fields, net.panel, lattice(net.pattern()));
}

Lattice lattice(const SquareNetScene& net) {
  return lattice(SquarePattern{.pitch = net.pitch, .wire_diameter = net.wire_diameter});
}
Lattice lattice(const RhombicNetScene& net) {
  return lattice(net.pattern());
}
Lattice lattice(const HexagonalNetScene& net) {
  return lattice(net.pattern());
}
Lattice lattice(const RingNetScene& net) {
  return lattice(net.pattern());
}

Net generate(const RhombicNetScene& net) {
  return clip(lattice(net), make_panel(net.panel));
}
Net generate(const HexagonalNetScene& net) {
  return clip(lattice(net), make_panel(net.panel));
}
Net generate(const RingNetScene& net) {
  return clip(lattice(net), make_panel(net.panel));
}

Net generate_polygons(const RingNetScene& net) {
  Net polygons = ring_polygons(net.inner_diameter, make_panel(net.panel));
  polygons.surface.parts.front().wire_radius = net.pattern().bundle_diameter() / 2;
  return polygons;
}

std::vector<core::Fields::Alternative> net_alternatives(
    const std::vector<core::Fields::Alternative>& others) {
  std::vector<core::Fields::Alternative> all{
      {"square_net", "a net of square openings"},
      {"rhombic_net", "chain-link: a net of rhombic openings"},
      {"hexagonal_net", "a net of hexagonal openings with double twists"},
      {"ring_net", "a net of interlocked rings, each linked with four others"}};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace talus::mesh
