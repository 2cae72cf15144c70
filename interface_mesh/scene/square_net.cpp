#include "interface_mesh/scene/square_net.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

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

bool are_parallel(const core::Vector3& a, const core::Vector3& b) {
  return a.cross(b).norm() <= 1e-9 * a.norm() * b.norm();
}

}  // namespace

void describe(core::Fields& fields, SquareNetScene& net) {
  fields.required("corner", net.corner, {.unit = "m", .help = "where the net's south-west corner is"});
  fields.required("size", net.size,
                  {.unit = "m", .range = core::positive, .help = "lengths of the south and the west edge"});
  fields.required("pitch", net.pitch,
                  {.unit = "m", .range = core::positive, .help = "distance of neighbouring wires"});
  fields.with_default("along", net.along, {.help = "direction of the south edge"});
  fields.with_default("across", net.across, {.help = "direction of the west edge"});
  fields.with_default(
      "wire_diameter", net.wire_diameter,
      {.unit = "m", .range = core::not_negative, .help = "thickness of the wires in contact"});
  fields.rule(net.size.empty() || net.size.size() == 2, "size",
              fmt::format("needs two lengths, but has {}", net.size.size()));
  fields.rule(!are_parallel(net.along, net.across), "across", "must not be zero or parallel to 'along'");
  if (net.pitch <= 0) return;
  for (const double size : net.size) {
    fields.rule(
        is_multiple(size, net.pitch), "pitch",
        fmt::format("must divide the size: {:g} m is {:g} times {:g} m", size, size / net.pitch, net.pitch));
    fields.rule(size / net.pitch <= most_openings, "pitch",
                fmt::format("gives more than {:g} openings along an edge", most_openings));
  }
}

Net generate(const SquareNetScene& net) {
  const auto openings = [&](double size) { return static_cast<Index>(std::lround(size / net.pitch)); };
  return generate(SquareNet{.corner = net.corner,
                            .along = net.along,
                            .across = net.across,
                            .lengths = {net.size[0], net.size[1]},
                            .openings = {openings(net.size[0]), openings(net.size[1])},
                            .wire_diameter = net.wire_diameter});
}

}  // namespace talus::mesh
