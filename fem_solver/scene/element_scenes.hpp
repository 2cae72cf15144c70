#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/scene/fields.hpp"
#include "fem_solver/materials/plane_stress.hpp"
#include "fem_solver/scene/conditions.hpp"

/// What the elements of a part are made of: the keys `bar`, `cable`, `sliding_cable`, `membrane`.
namespace talus::fem {

/// Area, density and elastic law of bars and ropes.
struct AxialScene {
  double area = 0;                      ///< m^2
  double density = 0;                   ///< kg/m^3
  double youngs_modulus = 0;            ///< Pa
  double prestress = 0;                 ///< Pa, second Piola-Kirchhoff
  std::optional<double> breaking_load;  ///< N
};
/// What an element bears before it is lost; the first that is exceeded counts.
struct BreaksScene {
  std::optional<double> force;   ///< N
  std::optional<double> strain;  ///< 1
  std::optional<double> work;    ///< J, of each element
};
void describe(core::Fields& fields, BreaksScene& breaks);

struct BarScene : AxialScene {
  std::optional<double> second_moment;  ///< m^4
};
struct CableScene : AxialScene {
  std::optional<BreaksScene> breaks;
};
void describe(core::Fields& fields, BarScene& bar);
void describe(core::Fields& fields, CableScene& cable);

/// What a rope meets at some of its nodes: its own coefficient, or a clamp.
struct FrictionAtScene {
  NodeSelection where;
  std::optional<double> coefficient;  ///< mu of the capstan equation; 0: runs freely
  bool clamped = false;
};
void describe(core::Fields& fields, FrictionAtScene& friction);

/// One rope that runs through all its nodes.
struct SlidingCableScene : AxialScene {
  std::optional<double> slider_size;  ///< m
  std::optional<double> friction;  ///< mu of the capstan equation, at nodes that `friction_at` does not name
  std::vector<FrictionAtScene> friction_at;
  std::optional<BreaksScene> breaks;
  bool has_friction() const { return friction || !friction_at.empty(); }
};
void describe(core::Fields& fields, SlidingCableScene& rope);

/// A rope that yields.
struct ElasticPlasticCableScene : AxialScene {
  double yield_stress = 0;  ///< Pa
  double hardening = 0;     ///< Pa
  std::optional<BreaksScene> breaks;
};
void describe(core::Fields& fields, ElasticPlasticCableScene& rope);

struct EndStopScene {
  double stiffness = 0;  ///< N/m
  double width = 0;      ///< m
};
void describe(core::Fields& fields, EndStopScene& stop);

/// A rope brake; every element of the part is one.
struct BrakeScene {
  std::vector<std::pair<double, double>> table;  ///< elongation (m), force (N)
  double mass_per_length = 0;                    ///< kg/m
  std::optional<double> breaking_load;           ///< N
  std::optional<EndStopScene> end_stop;          ///< absent: initial stiffness over a twentieth of the travel
  std::optional<BreaksScene> breaks;
};
void describe(core::Fields& fields, BrakeScene& brake);

/// When a ring is lost.
struct RingBreaksScene {
  std::optional<double> force;  ///< N, along the ring; absent: as calibrated
};
void describe(core::Fields& fields, RingBreaksScene& breaks);

/// Closed rings of wire; in a part with `ring_net` the net says how they are wound.
struct RingScene {
  std::optional<std::int64_t> windings;
  std::optional<double> wire_diameter;   ///< m
  std::optional<double> inner_diameter;  ///< m
  double density = 7850;                 ///< kg/m^3
  double strength = 1.77e9;              ///< Pa
  std::optional<double> breaking_load;   ///< N
  std::optional<RingBreaksScene> breaks;
};
void describe(core::Fields& fields, RingScene& ring);

void describe(core::Fields& fields, IsotropicSheet& sheet);

struct OrthotropicScene {
  OrthotropicSheet sheet;
  std::optional<double> poissons_ratio_yx;
};
void describe(core::Fields& fields, OrthotropicScene& sheet);

struct MembranePrestressScene {
  PlaneStress<double> stress{0, 0, 0};
};
void describe(core::Fields& fields, MembranePrestressScene& prestress);

struct TensionFieldScene {
  enum class WrinkleDirection { iterated, principal } wrinkle_direction = WrinkleDirection::iterated;
};
void describe(core::Fields& fields, TensionFieldScene& field);

/// Constant-strain triangles in plane stress.
struct MembraneScene {
  double thickness = 0;  ///< m
  double density = 0;    ///< kg/m^3
  std::variant<IsotropicSheet, OrthotropicScene> elasticity;
  std::optional<core::Vector3> material_axis;
  MembranePrestressScene prestress;
  std::optional<TensionFieldScene> tension_field;
};
void describe(core::Fields& fields, MembraneScene& membrane);

/// An element that the program has brought along.
struct UserElementScene {
  std::string name;
  std::vector<double> parameters;
};
void describe(core::Fields& fields, UserElementScene& element);

using ElementScene = std::variant<BarScene, CableScene, SlidingCableScene, ElasticPlasticCableScene,
                                  BrakeScene, RingScene, MembraneScene, UserElementScene>;
void describe_element(core::Fields& fields, ElementScene& element);

}  // namespace talus::fem
