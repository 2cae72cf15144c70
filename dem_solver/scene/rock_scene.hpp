#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/scene/fields.hpp"
#include "dem_solver/contact/materials.hpp"
#include "dem_solver/rocks/rocks.hpp"
#include "interface_mesh/scene/mesh_file.hpp"

/// `particles.rocks` of a scene.
namespace talus::dem {

/// The union of spheres written out.
struct SpheresShapeScene {
  std::vector<core::Vector3> centres;  ///< m
  std::vector<double> radii;           ///< m
};
void describe(core::Fields& fields, SpheresShapeScene& shape);

/// A cube without its corners, or a test block of the guideline.
struct BlockScene {
  enum class Form { cut_corners, eota_111, eota_221 } form = Form::cut_corners;
  std::optional<double> edge;       ///< m
  std::optional<double> mass;       ///< kg; gives the edge
  std::optional<double> cut;        ///< of the edge; absent: 0.25
  std::optional<double> deviation;  ///< m; absent: 5 % of the edge
  std::optional<double> spacing;    ///< m; of spheres along the surface in place of filling ones
};
void describe(core::Fields& fields, BlockScene& block);

/// A closed surface from a file.
struct SurfaceScene {
  mesh::MeshFileScene file;
  std::optional<double> deviation, spacing;  ///< m; one of both
};
void describe(core::Fields& fields, SurfaceScene& surface);

struct RockScene {
  std::string material;
  std::variant<SpheresShapeScene, BlockScene, SurfaceScene> shape;
  core::Vector3 at = core::Vector3::Zero();        ///< m; the centre of mass
  core::Vector3 velocity = core::Vector3::Zero();  ///< m/s
  core::Vector3 spin = core::Vector3::Zero();      ///< rad/s
  core::Vector3 turned = core::Vector3::Zero();    ///< rad; rotation vector of the shape before the start
};
void describe(core::Fields& fields, RockScene& rock);

/// A rock as the solver takes it, and its surface for pictures where it has one.
struct BuiltRock {
  RockInput rock;
  std::vector<SphereInput> spheres;  ///< their `rock` and `material` are still to be set
  mesh::Surface surface;             ///< positions in the rock's principal axes, about its centre
  double deviation = 0;              ///< m; of the surface's nodes from the spheres, 0 without a surface
};
/// Whether the rock's spheres lie along its surface, each for the share of it next to it.
bool stands_for_surface(const RockScene& rock);
/// @throws ConfigError for a surface that is no closed solid, or cannot be filled
BuiltRock build_rock(const std::string& name, const RockScene& scene, double density);

}  // namespace talus::dem
