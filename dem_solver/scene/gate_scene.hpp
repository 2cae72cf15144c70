#pragma once

#include <optional>

#include "core/scene/fields.hpp"
#include "dem_solver/output/gates.hpp"

/// `particles.gates` of a scene.
namespace talus::dem {

/// A plane or disc that counts the stones which pass it.
struct GateScene {
  core::Vector3 point = core::Vector3::Zero();  ///< m
  core::Vector3 normal = core::Vector3::Zero();
  std::optional<double> radius;  ///< m
};
void describe(core::Fields& fields, GateScene& gate);

Gate make_gate(const std::string& name, const GateScene& scene);

}  // namespace talus::dem
