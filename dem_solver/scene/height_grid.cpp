#include "dem_solver/scene/height_grid.hpp"

#include <cmath>

#include "core/errors.hpp"
#include "dem_solver/scene/ascii_grid.hpp"

namespace talus::dem {

namespace {

/// Adds two triangles for each four neighbours with heights, in the grid's own numbers.
void add_triangles(const AsciiGrid& grid, mesh::Surface& surface) {
  for (mesh::Index row = 0; row + 1 < grid.rows; ++row)
    for (mesh::Index column = 0; column + 1 < grid.columns; ++column) {
      const mesh::Index a = row * grid.columns + column, b = a + 1, d = a + grid.columns, c = d + 1;
      const double rise_ac = std::abs(grid.height(column + 1, row + 1) - grid.height(column, row)),
                   rise_bd = std::abs(grid.height(column, row + 1) - grid.height(column + 1, row));
      if (std::isnan(rise_ac + rise_bd)) continue;
      if (rise_ac <= rise_bd)
        surface.triangles.insert(surface.triangles.end(), {{a, b, c}, {a, c, d}});
      else
        surface.triangles.insert(surface.triangles.end(), {{a, b, d}, {b, c, d}});
    }
}

/// Adds the nodes that triangles have, and numbers them by themselves.
void add_nodes(const AsciiGrid& grid, const core::Vector3& origin, mesh::Surface& surface) {
  std::vector<mesh::Index> number(static_cast<std::size_t>(grid.columns) * grid.rows, -1);
  for (auto& triangle : surface.triangles)
    for (mesh::Index& node : triangle) {
      mesh::Index& own = number[node];
      if (own < 0) {
        own = surface.node_count();
        const mesh::Index column = node % grid.columns, row = node / grid.columns;
        const core::Vector3 p = grid.corner + core::Vector3(column * grid.column_width, row * grid.row_width,
                                                            grid.height(column, row));
        const core::Vector3 q = p - origin;
        surface.positions.insert(surface.positions.end(), q.data(), q.data() + 3);
      }
      node = own;
    }
}

}  // namespace

void describe(core::Fields& fields, HeightGridScene& grid) {
  fields.required("path", grid.path,
                  {.help = "an Esri ASCII grid (.asc) in metres, from this file's folder"});
  fields.with_default("origin", grid.origin,
                      {.unit = "m", .help = "the point of the map where the scene's origin is"});
}

mesh::Surface height_grid(const HeightGridScene& scene) {
  const AsciiGrid grid = read_ascii_grid(scene.path);
  mesh::Surface surface;
  add_triangles(grid, surface);
  if (surface.triangles.empty())
    throw core::ConfigError(scene.path.string() + ": has no four neighbours with heights");
  add_nodes(grid, scene.origin, surface);
  return surface;
}

}  // namespace talus::dem
