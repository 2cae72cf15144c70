#include "interface_mesh/tubes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "interface_mesh/points.hpp"

namespace talus::mesh {

using core::Vector3;

namespace {

void add_tube(const std::array<Vector3, 2>& ends, double radius, Index sides, Surface& tubes) {
  const Vector3 axis = (ends[1] - ends[0]).normalized();
  const Vector3 first = axis.unitOrthogonal(), second = axis.cross(first);
  const Index start = tubes.node_count();
  for (const auto& end : ends)
    for (Index k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides;
      append(tubes.positions, end + radius * (std::cos(angle) * first + std::sin(angle) * second));
    }
  for (Index k = 0; k < sides; ++k) {
    const Index a = start + k, b = start + (k + 1) % sides, c = b + sides, d = a + sides;
    tubes.triangles.insert(tubes.triangles.end(), {{a, b, c}, {a, c, d}});
  }
}

}  // namespace

Surface as_tubes(const Surface& wires, Index sides) {
  Surface tubes;
  for (const auto& part : wires.parts) {
    SurfacePart tube{.name = part.name, .material = part.material};
    tube.triangle_begin = static_cast<Index>(tubes.triangles.size());
    for (Index s = part.segment_begin; s < part.segment_end; ++s) {
      const auto [a, b] = wires.segments[static_cast<std::size_t>(s)];
      add_tube({point(wires.positions, a), point(wires.positions, b)}, part.wire_radius, sides, tubes);
    }
    tube.triangle_end = static_cast<Index>(tubes.triangles.size());
    tubes.parts.push_back(std::move(tube));
  }
  return tubes;
}

}  // namespace talus::mesh
