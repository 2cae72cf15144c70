#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/scene/fields.hpp"
#include "dem_solver/scene/height_grid.hpp"
#include "interface_mesh/scene/mesh_file.hpp"
#include "interface_mesh/scene/nets.hpp"
#include "interface_mesh/scene/sheet.hpp"

/// `particles.planes` and `particles.boundaries` of a scene.
namespace talus::dem {

struct PlaneScene {
  std::string material;
  core::Vector3 point = core::Vector3::Zero();  ///< m
  core::Vector3 normal = core::Vector3::Zero();
};
void describe(core::Fields& fields, PlaneScene& plane);

/// Nodes and what spans between them, written out.
struct NodesScene {
  std::vector<core::Vector3> positions;  ///< m
  std::vector<std::int64_t> segments;    ///< two nodes each
  std::vector<std::int64_t> triangles;   ///< three nodes each
};
void describe(core::Fields& fields, NodesScene& nodes);

struct BoundaryScene {
  std::string material;
  std::optional<double> wire_radius;      ///< m; absent: that of the net, or 0
  std::optional<core::Vector3> velocity;  ///< m/s
  mesh::NetChoice<mesh::SheetScene, mesh::MeshFileScene, HeightGridScene, NodesScene> shape;
};
void describe(core::Fields& fields, BoundaryScene& boundary);

/// The surface of all boundaries; its parts are named after the boundary they belong to.
/// @pre the scene was read without complaints
/// @throws ConfigError with the faults of a surface: triangles without area, segments without length ...
mesh::Surface make_surface(const std::vector<std::pair<std::string, BoundaryScene>>& boundaries);

/// Adds the nodes, cells and parts of another surface behind those of the first.
void append(mesh::Surface& to, const mesh::Surface& more);

}  // namespace talus::dem
