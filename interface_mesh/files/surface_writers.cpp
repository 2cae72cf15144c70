#include "interface_mesh/files/surface_writers.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <Eigen/Geometry>

#include "interface_mesh/points.hpp"

namespace talus::mesh {

namespace {

void write_point(std::ostream& out, const char* before, const core::Vector3& at) {
  fmt::print(out, "{}{} {} {}\n", before, at.x(), at.y(), at.z());
}

}  // namespace

void write_stl(std::ostream& out, const Surface& surface) {
  out << "solid talus\n";
  for (const auto& [a, b, c] : surface.triangles) {
    const core::Vector3 p = point(surface.positions, a), q = point(surface.positions, b),
                        r = point(surface.positions, c);
    write_point(out, "facet normal ", (q - p).cross(r - p).normalized());
    out << "outer loop\n";
    for (const auto& corner : {p, q, r}) write_point(out, "vertex ", corner);
    out << "endloop\nendfacet\n";
  }
  out << "endsolid talus\n";
}

void write_obj(std::ostream& out, const Surface& surface) {
  for (Index node = 0; node < surface.node_count(); ++node)
    write_point(out, "v ", point(surface.positions, node));
  for (const auto& [a, b, c] : surface.triangles) fmt::print(out, "f {} {} {}\n", a + 1, b + 1, c + 1);
}

void write_ply(std::ostream& out, const Surface& surface) {
  fmt::print(
      out,
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      surface.node_count(), surface.triangles.size());
  for (Index node = 0; node < surface.node_count(); ++node)
    write_point(out, "", point(surface.positions, node));
  for (const auto& [a, b, c] : surface.triangles) fmt::print(out, "3 {} {} {}\n", a, b, c);
}

}  // namespace talus::mesh
