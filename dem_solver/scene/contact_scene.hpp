#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/scene/fields.hpp"

/// `particles.materials` and `particles.contacts` of a scene.
namespace talus::dem {

struct MaterialScene {
  std::optional<double> density;  ///< kg/m^3; absent: a material of boundaries only
  double youngs_modulus = 0;      ///< Pa
  double poissons_ratio = 0;
};
void describe(core::Fields& fields, MaterialScene& material);

struct HertzScene {
  enum class Loss { dashpot, hysteretic };
  double restitution = 1;
  Loss loss = Loss::dashpot;
};
void describe(core::Fields& fields, HertzScene& law);

struct LinearScene {
  double stiffness = 0;  ///< N/m
  double tangential_ratio = 2.0 / 7;
  double restitution = 1;
};
void describe(core::Fields& fields, LinearScene& law);

struct FoundationScene {
  double stiffness_per_area = 0;  ///< Pa/m
  double tangential_ratio = 2.0 / 7;
  double restitution = 1;
};
void describe(core::Fields& fields, FoundationScene& law);

/// One coefficient, or one that falls from rest to sliding.
struct FrictionScene {
  std::optional<double> coefficient;
  std::optional<double> at_rest, sliding, decay_speed;  ///< 1, 1, m/s
};
void describe(core::Fields& fields, FrictionScene& friction);

struct ConstantTorqueScene {
  double coefficient = 0;
};
void describe(core::Fields& fields, ConstantTorqueScene& rolling);

struct ElasticPlasticScene {
  double coefficient = 0;
  double damping = 0.3;  ///< over critical
};
void describe(core::Fields& fields, ElasticPlasticScene& rolling);

struct RollingScene {
  std::variant<ConstantTorqueScene, ElasticPlasticScene> kind;
};
void describe(core::Fields& fields, RollingScene& rolling);

struct ContactScene {
  std::vector<std::string> between;  ///< two materials
  std::variant<HertzScene, LinearScene, FoundationScene> normal;
  std::optional<FrictionScene> friction;
  std::optional<RollingScene> rolling;
};
void describe(core::Fields& fields, ContactScene& contact);

}  // namespace talus::dem
