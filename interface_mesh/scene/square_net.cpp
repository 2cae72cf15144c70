#include "interface_mesh/scene/square_net.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/scene/plausible.hpp"
#include "interface_mesh/net_patterns.hpp"
#include "interface_mesh/open_rim.hpp"
#include "interface_mesh/square_net.hpp"

namespace talus::mesh {

namespace {

/// A size is a multiple of the pitch when it misses one by less than this part of a pitch: units such as 3 ft
/// are not exact.
constexpr double multiple_tolerance = 1e-6;
constexpr double most_openings = 10000;

bool is_multiple(double size, double pitch) {
  const double openings = size / pitch;
  return openings > 0.5 &&
         std::abs(openings - std::round(openings)) < multiple_tolerance * std::max(1.0, openings);
}

Net with_rim(const SquareNetScene& scene) {
  const Panel panel = make_panel(scene.panel);
  if (!scene.panel.is_rectangle())
    return clip(lattice(SquarePattern{.pitch = scene.pitch, .wire_diameter = scene.wire_diameter}), panel);
  const Vector2 size = panel.outline[2];
  const auto openings = [&](double length) { return static_cast<Index>(std::lround(length / scene.pitch)); };
  return generate(SquareNet{.corner = panel.origin,
                            .along = panel.along,
                            .across = panel.across,
                            .lengths = {size.x(), size.y()},
                            .openings = {openings(size.x()), openings(size.y())},
                            .wire_diameter = scene.wire_diameter});
}

}  // namespace

void describe(core::Fields& fields, SquareNetScene& net) {
  describe(fields, net.panel);
  fields.required("pitch", net.pitch,
                  {.unit = "m", .range = core::positive, .help = "distance of neighbouring wires"});
  fields.with_default("wire_diameter", net.wire_diameter,
                      {.unit = "m",
                       .range = core::not_negative,
                       .help = "thickness of the wires in contact",
                       .plausible = core::plausible::wire_diameter});
  fields.choice("rim", net.rim, {"wires", "open"},
                "what runs along the outline: wires, or nothing where the structure adds ropes of its own");
  if (net.pitch <= 0 || !net.panel.size) return;
  for (const double size : *net.panel.size) {
    fields.rule(
        is_multiple(size, net.pitch), "pitch",
        fmt::format("must divide the size: {:g} m is {:g} times {:g} m", size, size / net.pitch, net.pitch));
    fields.rule(size / net.pitch <= most_openings, "pitch",
                fmt::format("gives more than {:g} openings along an edge", most_openings));
  }
}

Net generate(const SquareNetScene& scene) {
  return scene.rim == SquareNetScene::Rim::open ? without_rim_wires(with_rim(scene)) : with_rim(scene);
}

}  // namespace talus::mesh
