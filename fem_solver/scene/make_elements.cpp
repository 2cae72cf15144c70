#include "fem_solver/scene/make_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/errors.hpp"
#include "fem_solver/scene/node_sets.hpp"
#include "interface_mesh/net_patterns.hpp"

namespace talus::fem {
namespace {

AxialPart axial_part(const AxialScene& scene) {
  return {
      .section = {.area = scene.area, .youngs_modulus = scene.youngs_modulus, .prestress = scene.prestress},
      .density = scene.density};
}

PlaneElasticity elasticity(const MembraneScene& scene) {
  if (const auto* sheet = std::get_if<IsotropicSheet>(&scene.elasticity))
    return PlaneElasticity::from(*sheet);
  return PlaneElasticity::from(std::get<OrthotropicScene>(scene.elasticity).sheet);
}

/// The stop's width as a share of the travel where the scene gives no stop.
constexpr double usual_stop_width = 0.05;

BrakeLaw brake_law(const BrakeScene& scene) {
  if (scene.end_stop) return BrakeLaw({scene.table, scene.end_stop->stiffness, scene.end_stop->width});
  if (scene.table.empty()) return BrakeLaw({scene.table, 1, 1});  // which refuses the table
  return BrakeLaw({scene.table, scene.table.front().second / scene.table.front().first,
                   usual_stop_width * scene.table.back().first});
}

BreakingLimits limits_of(const BreaksScene& breaks) {
  constexpr double none = std::numeric_limits<double>::infinity();
  return {.force = breaks.force.value_or(none),
          .strain = breaks.strain.value_or(none),
          .work = breaks.work.value_or(none)};
}

RingDescription description_of(const RingScene& scene) {
  return {.windings = static_cast<int>(*scene.windings),
          .wire_diameter = *scene.wire_diameter,
          .inner_diameter = *scene.inner_diameter,
          .strength = scene.strength};
}

/// kg; of all windings.
double ring_mass(const RingDescription& ring, double density) {
  const mesh::RingPattern pattern{
      .inner_diameter = ring.inner_diameter, .wire_diameter = ring.wire_diameter, .windings = ring.windings};
  const double pi = std::numbers::pi, axis = pi * (ring.inner_diameter + pattern.bundle_diameter());
  return density * ring.windings * pi / 4 * ring.wire_diameter * ring.wire_diameter * axis;
}

struct Maker {
  const MeshedElements& elements;
  const Model& model;

  ElementBatch operator()(const BarScene& bar) const {
    need_segments("bar");
    return BarBatch(axial_part(bar), elements.segments, model.reference);
  }
  ElementBatch operator()(const CableScene& cable) const {
    need_segments("cable");
    if (cable.breaks)
      return BreakingCableBatch(
          {{{axial_part(cable).section}, limits_of(*cable.breaks)}, cable.density * cable.area},
          elements.segments, model.reference);
    return CableBatch(axial_part(cable), elements.segments, model.reference);
  }
  ElementBatch operator()(const SlidingCableScene& rope) const {
    need_segments("sliding cable");
    if (rope.has_friction()) {
      FrictionalCableBatch cable({axial_part(rope), friction_of(rope), rope.slider_size.value_or(0)},
                                 elements.segments, model.reference);
      if (rope.breaks) return BreakingFrictionalCableBatch(std::move(cable), limits_of(*rope.breaks));
      return cable;
    }
    SlidingCableBatch cable(axial_part(rope), rope.slider_size.value_or(0), elements.segments,
                            model.reference);
    if (rope.breaks) return BreakingRopeBatch(std::move(cable), limits_of(*rope.breaks));
    return cable;
  }
  ElementBatch operator()(const ElasticPlasticCableScene& rope) const {
    need_segments("cable");
    const ElasticPlasticRope law{axial_part(rope).section, rope.yield_stress, rope.hardening};
    const double mass_per_length = rope.density * rope.area;
    if (rope.breaks)
      return BreakingElasticPlasticBatch({{law, limits_of(*rope.breaks)}, mass_per_length}, elements.segments,
                                         model.reference);
    return ElasticPlasticBatch({law, mass_per_length}, elements.segments, model.reference);
  }
  ElementBatch operator()(const BrakeScene& brake) const {
    need_segments("brake");
    if (brake.breaks)
      return BreakingBrakeBatch({{brake_law(brake), limits_of(*brake.breaks)}, brake.mass_per_length},
                                elements.segments, model.reference);
    return BrakeBatch({brake_law(brake), brake.mass_per_length}, elements.segments, model.reference);
  }
  ElementBatch operator()(const RingScene& scene) const {
    need_segments("ring");
    const RingDescription ring = description_of(scene);
    const RingLaw law = ring_law(ring);
    const double mass = ring_mass(ring, scene.density);
    if (!scene.breaks)
      return PlainRingBatch({law, mass, ring.inner_diameter}, elements.segments, model.reference);
    const BreakingLimits limits{.force = scene.breaks->force.value_or(law.breaking().tension)};
    return BreakingRingBatch({{law, limits}, mass, ring.inner_diameter}, elements.segments, model.reference);
  }
  ElementBatch operator()(const MembraneScene& membrane) const {
    if (elements.triangles.empty())
      throw core::ConfigError("a membrane needs a shape made of triangles, not of lines");
    if (!membrane.tension_field) return membrane_of<LinearSheet>(membrane);
    if (membrane.tension_field->wrinkle_direction == TensionFieldScene::WrinkleDirection::principal)
      return membrane_of<TensionField<PrincipalWrinkles>>(membrane);
    return membrane_of<TensionField<ExactWrinkles>>(membrane);
  }

  ElementBatch operator()(const UserElementScene& scene) const {
    const MakeUserElement& make = user_element(scene.name);
    try {
      if (!elements.segments.empty())
        return UserLineBatch(make, scene.parameters, elements.segments, model.reference);
      return UserTriangleBatch(make, scene.parameters, elements.triangles, model.reference);
    } catch (const std::exception& error) {
      throw core::ConfigError(fmt::format("user_element: {}", error.what()));
    }
  }

 private:
  /// At each inner node of the rope.
  std::vector<double> friction_of(const SlidingCableScene& rope) const {
    std::vector<double> friction(elements.segments.size() - 1, rope.friction.value_or(0));
    for (const auto& at : rope.friction_at)
      for (const Index node : select_nodes(model, at.where)) {
        const auto inner = std::ranges::find(elements.segments, node, [](const auto& s) { return s[1]; });
        if (inner == elements.segments.end() || inner + 1 == elements.segments.end())
          throw core::ConfigError(
              fmt::format("friction_at: the rope does not run through {}", node_name(model, node)));
        friction[static_cast<std::size_t>(inner - elements.segments.begin())] =
            at.clamped ? std::numeric_limits<double>::infinity() : *at.coefficient;
      }
    return friction;
  }
  void need_segments(const char* element) const {
    if (elements.segments.empty())
      throw core::ConfigError(fmt::format("a {} needs a shape made of lines, not of triangles", element));
  }
  template <class Law>
  ElementBatch membrane_of(const MembraneScene& scene) const {
    return MembraneBatch<Law>({scene.thickness, scene.density, scene.material_axis},
                              Law(elasticity(scene), scene.prestress.stress), elements.triangles,
                              model.reference);
  }
};

}  // namespace

ElementScene of_wires(const ElementScene& scene, int wires) {
  ElementScene together = scene;
  if (wires == 1) return together;
  std::visit(
      [&](auto& element) {
        using Element = std::decay_t<decltype(element)>;
        const auto times = [&](std::optional<double>& value) {
          if (value) *value *= wires;
        };
        if constexpr (std::is_base_of_v<AxialScene, Element>) {
          element.area *= wires;
          times(element.breaking_load);
          if constexpr (std::is_same_v<Element, BarScene>) times(element.second_moment);
          if constexpr (requires { element.breaks; })
            if (element.breaks) {
              times(element.breaks->force);
              times(element.breaks->work);
            }
        }
      },
      together);
  return together;
}

double breaking_load_of(const ElementScene& scene) {
  return std::visit(
      [](const auto& element) {
        std::optional<double> load;
        if constexpr (std::is_same_v<std::decay_t<decltype(element)>, RingScene>)
          load = ring_law(description_of(element)).breaking().tension;
        if constexpr (requires { element.breaks; })
          if (element.breaks && element.breaks->force) load = element.breaks->force;
        if constexpr (requires { element.breaking_load; })
          if (element.breaking_load) load = element.breaking_load;
        return load.value_or(0);
      },
      scene);
}

double buckling_load_of(const ElementScene& scene, const ElementBatch& elements) {
  const auto* bar = std::get_if<BarScene>(&scene);
  const auto* batch = std::get_if<BarBatch>(&elements);
  if (bar == nullptr || batch == nullptr || !bar->second_moment) return 0;
  double longest = 0;
  for (Index e = 0; e < batch->size(); ++e) longest = std::max(longest, batch->reference_length(e));
  const double pi = std::numbers::pi;
  return pi * pi * bar->youngs_modulus * *bar->second_moment / (longest * longest);
}

ElementBatch make_elements(const ElementScene& scene, const MeshedElements& elements, const Model& model) {
  try {
    return std::visit(Maker{elements, model}, scene);
  } catch (const core::ConfigError& error) {
    throw core::ConfigError(fmt::format("{}: {}", elements.key, error.what()));
  }
}

}  // namespace talus::fem
