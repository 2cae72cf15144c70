#include "dem_solver/scene/gate_scene.hpp"

namespace talus::dem {

void describe(core::Fields& fields, GateScene& gate) {
  fields.required("point", gate.point, {.unit = "m", .help = "of the plane; the centre of the disc"});
  fields.required("normal", gate.normal, {.help = "stones that pass along it count, each once; any length"});
  fields.optional("radius", gate.radius,
                  {.unit = "m", .range = core::positive, .help = "of a disc; absent: the whole plane"});
  fields.rule(gate.normal.norm() > 0, "normal", "must not be zero");
}

Gate make_gate(const std::string& name, const GateScene& scene) {
  const auto triple_of = [](const core::Vector3& v) { return Triple<double>{v.x(), v.y(), v.z()}; };
  Gate gate{.name = name, .point = triple_of(scene.point), .normal = triple_of(scene.normal.normalized())};
  if (scene.radius) gate.radius = *scene.radius;
  return gate;
}

}  // namespace talus::dem
