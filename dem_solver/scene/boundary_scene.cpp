#include "dem_solver/scene/boundary_scene.hpp"

#include <algorithm>

#include "core/scene/plausible.hpp"
#include "interface_mesh/net.hpp"
#include "interface_mesh/surface_checks.hpp"

namespace talus::dem {

namespace {

bool all_below(const std::vector<std::int64_t>& indices, std::size_t count) {
  return std::ranges::all_of(
      indices, [count](std::int64_t i) { return i >= 0 && i < static_cast<std::int64_t>(count); });
}

mesh::Surface surface_of(const NodesScene& nodes) {
  mesh::Surface surface;
  for (const core::Vector3& p : nodes.positions)
    surface.positions.insert(surface.positions.end(), p.data(), p.data() + 3);
  const auto node = [](std::int64_t i) { return static_cast<mesh::Index>(i); };
  for (std::size_t k = 0; k + 1 < nodes.segments.size(); k += 2)
    surface.segments.push_back({node(nodes.segments[k]), node(nodes.segments[k + 1])});
  for (std::size_t k = 0; k + 2 < nodes.triangles.size(); k += 3)
    surface.triangles.push_back(
        {node(nodes.triangles[k]), node(nodes.triangles[k + 1]), node(nodes.triangles[k + 2])});
  return surface;
}
mesh::Surface surface_of(const HeightGridScene& grid) {
  return height_grid(grid);
}
template <class Shape>
mesh::Surface surface_of(const Shape& shape) {
  return mesh::generate(shape).surface;
}

/// The boundary's shape as a surface whose parts are the boundary's.
mesh::Surface surface_of(const std::string& name, const BoundaryScene& boundary) {
  mesh::Surface surface = std::visit([](const auto& shape) { return surface_of(shape); }, boundary.shape);
  if (surface.parts.empty())
    surface.parts = {{.name = name,
                      .segment_end = static_cast<mesh::Index>(surface.segments.size()),
                      .triangle_end = static_cast<mesh::Index>(surface.triangles.size())}};
  for (auto& part : surface.parts) {
    part.name = name;
    part.material = boundary.material;
    part.wire_radius = boundary.wire_radius.value_or(part.wire_radius);
  }
  mesh::check(surface, "particles.boundaries." + name);
  return surface;
}

}  // namespace

void describe(core::Fields& fields, PlaneScene& plane) {
  fields.required("material", plane.material, {.help = "contact material"});
  fields.required("point", plane.point, {.unit = "m", .help = "a point of the plane"});
  fields.required("normal", plane.normal, {.help = "points to the side where the spheres are; any length"});
  fields.rule(plane.normal.norm() > 0, "normal", "must not be zero");
}

void describe(core::Fields& fields, NodesScene& nodes) {
  fields.required("positions", nodes.positions, {.unit = "m", .help = "of the nodes"});
  fields.with_default("segments", nodes.segments,
                      {.range = core::not_negative, .help = "wires, two node numbers each, from 0"});
  fields.with_default("triangles", nodes.triangles,
                      {.range = core::not_negative, .help = "faces, three node numbers each, from 0"});
  fields.rule(!nodes.segments.empty() || !nodes.triangles.empty(), "segments",
              "needs `segments` or `triangles`");
  fields.rule(nodes.segments.size() % 2 == 0, "segments", "needs an even number of node numbers");
  fields.rule(nodes.triangles.size() % 3 == 0, "triangles", "needs a multiple of three node numbers");
  const std::string last = "must be node numbers from 0 to " + std::to_string(nodes.positions.size() - 1);
  fields.rule(all_below(nodes.segments, nodes.positions.size()), "segments", last);
  fields.rule(all_below(nodes.triangles, nodes.positions.size()), "triangles", last);
}

void describe(core::Fields& fields, BoundaryScene& boundary) {
  fields.required("material", boundary.material, {.help = "contact material"});
  fields.optional("wire_radius", boundary.wire_radius,
                  {.unit = "m",
                   .range = core::not_negative,
                   .help = "of segments; 0: their axes are touched; absent: that of the net, or 0",
                   .plausible = core::plausible::wire_radius});
  fields.optional(
      "velocity", boundary.velocity,
      {.unit = "m/s", .help = "constant; absent: at rest", .plausible = core::plausible::velocity});
  fields.one_of(boundary.shape, mesh::net_alternatives({{"sheet", "a flat panel of triangles"},
                                                        {"mesh_file", "a mesh made elsewhere"},
                                                        {"height_grid", "terrain from a grid of heights"},
                                                        {"nodes", "wires and triangles written out"}}));
}

mesh::Surface make_surface(const std::vector<std::pair<std::string, BoundaryScene>>& boundaries) {
  mesh::Surface all;
  for (const auto& [name, boundary] : boundaries) append(all, surface_of(name, boundary));
  return all;
}

void append(mesh::Surface& to, const mesh::Surface& more) {
  const mesh::Index node = to.node_count();
  const auto segment = static_cast<mesh::Index>(to.segments.size()),
             triangle = static_cast<mesh::Index>(to.triangles.size());
  if (!more.start.empty()) {
    to.start.resize(to.positions.size(), 0.0);
    to.start.insert(to.start.end(), more.start.begin(), more.start.end());
  }
  to.positions.insert(to.positions.end(), more.positions.begin(), more.positions.end());
  if (!to.start.empty()) to.start.resize(to.positions.size(), 0.0);
  for (const auto& [a, b] : more.segments) to.segments.push_back({a + node, b + node});
  for (const auto& [a, b, c] : more.triangles) to.triangles.push_back({a + node, b + node, c + node});
  for (mesh::SurfacePart part : more.parts) {
    part.segment_begin += segment;
    part.segment_end += segment;
    part.triangle_begin += triangle;
    part.triangle_end += triangle;
    to.parts.push_back(part);
  }
}

}  // namespace talus::dem
