#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/sections.hpp"
#include "dem_solver/scene/boundary_scene.hpp"
#include "dem_solver/scene/contact_scene.hpp"
#include "dem_solver/scene/gate_scene.hpp"
#include "dem_solver/scene/rock_scene.hpp"
#include "dem_solver/scene/stream_scene.hpp"

/// The section `particles` of a scene.
namespace talus::dem {

struct SphereScene {
  std::string material;
  double radius = 0;                               ///< m
  core::Vector3 at = core::Vector3::Zero();        ///< m
  core::Vector3 velocity = core::Vector3::Zero();  ///< m/s
  core::Vector3 spin = core::Vector3::Zero();      ///< rad/s
};
void describe(core::Fields& fields, SphereScene& sphere);

/// See ImplicitVelocities.
struct ImplicitContactScene {
  double tolerance = 1e-4;  ///< largest change of a contact force in a sweep over the largest force
  std::int64_t most_sweeps = 1000;
};
void describe(core::Fields& fields, ImplicitContactScene& contact);

template <class T>
using Named = std::vector<std::pair<std::string, T>>;

struct ParticlesScene {
  std::optional<core::SolverScene> solver;
  std::optional<core::Vector3> gravity;  ///< m/s^2
  Named<MaterialScene> materials;
  std::vector<ContactScene> contacts;
  Named<SphereScene> spheres;
  Named<RockScene> rocks;
  Named<StreamScene> streams;
  Named<PlaneScene> planes;
  Named<BoundaryScene> boundaries;
  Named<GateScene> gates;
  std::optional<double> step;  ///< s
  std::optional<ImplicitContactScene> implicit_contact;
  /// Which features count; automatic: by whether a structure moves them.
  enum class FeatureRule { automatic, local_minima, tangent_plane } contact_rule = FeatureRule::automatic;
  enum class UnstableStep { refused, allowed } unstable_step = UnstableStep::refused;
  std::int64_t threads = 1;
};
void describe(core::Fields& fields, ParticlesScene& particles);

}  // namespace talus::dem
