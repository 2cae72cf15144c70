#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/scene/fields.hpp"
#include "core/scene/sections.hpp"
#include "fem_solver/scene/conditions.hpp"
#include "fem_solver/scene/element_scenes.hpp"
#include "fem_solver/scene/obstacles.hpp"
#include "fem_solver/scene/shapes.hpp"
#include "fem_solver/scene/slides.hpp"

/// The section `structure` of a scene.
namespace talus::fem {

struct DampingScene {
  double mass = 0;       ///< 1/s
  double stiffness = 0;  ///< s
};
void describe(core::Fields& fields, DampingScene& damping);

struct PartScene {
  std::string place;
  ShapeScene shape;
  ElementScene element;
  std::optional<core::Vector3> gravity;  ///< m/s^2; in place of the structure's
  std::optional<DampingScene> damping;   ///< in place of the structure's
};
void describe(core::Fields& fields, PartScene& part);
/// Whether it is nothing but nodes, and `element` means nothing.
inline bool has_no_element(const PartScene& part) {
  return std::holds_alternative<NodesScene>(part.shape);
}
inline bool is_made_of_rings(const PartScene& part) {
  return std::holds_alternative<RingScene>(part.element);
}

struct WeldScene {
  double tolerance = 0;  ///< m
};
void describe(core::Fields& fields, WeldScene& weld);

/// Central differences.
struct ExplicitScene {};
void describe(core::Fields& fields, ExplicitScene& method);

/// Mass on light nodes, for a longer explicit step.
struct MassScalingScene {
  double step = 0;  ///< s
};
void describe(core::Fields& fields, MassScalingScene& scaling);

/// Generalised-alpha method.
struct ImplicitScene {
  double spectral_radius = 0.8;
  double tolerance = 1e-9;
};
void describe(core::Fields& fields, ImplicitScene& method);

/// Equilibrium under loads that grow over the run.
struct StaticScene {
  std::int64_t steps = 10;
  double tolerance = 1e-9;
};
void describe(core::Fields& fields, StaticScene& method);

/// At rest under its own loads.
struct EquilibriumScene {
  std::int64_t steps = 10;
  double tolerance = 1e-10;
};
void describe(core::Fields& fields, EquilibriumScene& equilibrium);

/// The same, found by letting the structure fall into place.
struct RelaxationScene {
  std::int64_t steps = 200000;
  double tolerance = 1e-6;
};
void describe(core::Fields& fields, RelaxationScene& relaxation);

/// Where another run has left the same structure: what has yielded, slipped, run out or broken stays so.
struct AfterScene : RelaxationScene {
  std::filesystem::path state;
  enum class Motion { comes_to_rest, goes_on } motion = Motion::comes_to_rest;
};
void describe(core::Fields& fields, AfterScene& after);

/// Where the structure is at time 0; absent: as its shapes are written.
struct StartScene {
  std::variant<EquilibriumScene, RelaxationScene, AfterScene> from;
};
void describe(core::Fields& fields, StartScene& start);

using MethodScene = std::variant<std::monostate, ExplicitScene, ImplicitScene, StaticScene>;
/// Also where the scene names no method.
inline bool is_explicit(const MethodScene& method) {
  return std::holds_alternative<std::monostate>(method) || std::holds_alternative<ExplicitScene>(method);
}

struct StructureScene {
  std::optional<core::SolverScene> solver;
  std::optional<DampingScene> damping;
  std::optional<core::Vector3> gravity;                      ///< m/s^2
  std::vector<std::pair<double, double>> gravity_over_time;  ///< s, factor
  std::optional<mesh::MeshFileScene> mesh_file;
  std::vector<std::pair<std::string, PartScene>> parts;
  std::optional<WeldScene> weld;
  std::vector<NamedSlide> slides;
  std::vector<NamedObstacle> obstacles;
  std::vector<std::pair<std::string, NodeSelection>> node_sets;
  std::vector<SupportScene> supports;
  std::vector<LoadScene> loads;
  std::vector<PointMassScene> point_masses;
  std::vector<InitialDisplacementScene> initial_displacements;
  std::vector<InitialVelocityScene> initial_velocities;
  std::optional<StartScene> start;
  MethodScene method;
  std::optional<MassScalingScene> mass_scaling;
  std::optional<double> step;  ///< s
  enum class UnstableStep { refused, allowed } unstable_step = UnstableStep::refused;
};
void describe(core::Fields& fields, StructureScene& structure);

}  // namespace talus::fem
