#include "dem_solver/scene/build_model.hpp"

#include <algorithm>
#include <numbers>

#include "core/errors.hpp"
#include "dem_solver/scene/body_names.hpp"
#include "dem_solver/scene/overlap_check.hpp"
#include "dem_solver/scene/scene_rules.hpp"
#include "dem_solver/scene/triple_of.hpp"

namespace talus::dem {

namespace {

Material material_of(const std::string& name, const MaterialScene& scene) {
  return {.name = name,
          .density = scene.density.value_or(0),
          .youngs_modulus = scene.youngs_modulus,
          .poissons_ratio = scene.poissons_ratio};
}

PairParameters normal_parameters(const HertzScene& law, const EffectiveModuli& moduli) {
  if (law.loss == HertzScene::Loss::hysteretic)
    return pair_parameters(HystereticContact{law.restitution}, moduli);
  return pair_parameters(HertzContact{law.restitution}, moduli);
}
PairParameters normal_parameters(const FoundationScene& law, const EffectiveModuli&) {
  return pair_parameters(FoundationContact{law.stiffness_per_area, law.tangential_ratio, law.restitution});
}
PairParameters normal_parameters(const LinearScene& law, const EffectiveModuli&) {
  return pair_parameters(LinearContact{law.stiffness, law.tangential_ratio, law.restitution});
}

RollingCoefficients rolling_of(const ConstantTorqueScene& rolling) {
  return {.friction = rolling.coefficient};
}
RollingCoefficients rolling_of(const ElasticPlasticScene& rolling) {
  return {.friction = rolling.coefficient, .damping = rolling.damping};
}

PairParameters parameters_of(const ContactScene& contact, const EffectiveModuli& moduli) {
  PairParameters p =
      std::visit([&](const auto& law) { return normal_parameters(law, moduli); }, contact.normal);
  if (contact.friction) {
    const FrictionScene& f = *contact.friction;
    const double constant = f.coefficient.value_or(0);
    set_friction(p, {.at_rest = f.at_rest.value_or(constant),
                     .sliding = f.sliding.value_or(constant),
                     .decay_speed = f.decay_speed.value_or(0)});
  }
  if (contact.rolling)
    set_rolling(p, std::visit([](const auto& kind) { return rolling_of(kind); }, contact.rolling->kind));
  return p;
}

PairTable pair_table(const ParticlesScene& particles) {
  PairTable table(static_cast<Index>(particles.materials.size()));
  const std::vector<Material> materials = materials_of(particles);
  for (const ContactScene& contact : particles.contacts) {
    const auto a = material_index(particles, contact.between[0]),
               b = material_index(particles, contact.between[1]);
    table.set(static_cast<Index>(a), static_cast<Index>(b),
              parameters_of(contact, effective_moduli(materials[a], materials[b])));
  }
  return table;
}

/// m^2; what a sphere shows to a partner.
double disc_of(double radius) {
  return std::numbers::pi * radius * radius;
}

SphereInput sphere_of(const ParticlesScene& particles, const SphereScene& scene) {
  const auto material = material_index(particles, scene.material);
  const double volume = 4.0 / 3 * std::numbers::pi * scene.radius * scene.radius * scene.radius;
  return {.position = triple_of(scene.at),
          .velocity = triple_of(scene.velocity),
          .spin = triple_of(scene.spin),
          .radius = scene.radius,
          .mass = volume * particles.materials[material].second.density.value(),
          .material = static_cast<Index>(material),
          .rock = -1,
          .area = disc_of(scene.radius)};
}

double density_of(const ParticlesScene& particles, const std::string& material) {
  return particles.materials[material_index(particles, material)].second.density.value();
}

void add_facts_of_filling(const std::string& name, const BuiltRock& rock, std::vector<core::Fact>& facts) {
  const std::string place = "particles.rocks." + name;
  facts.push_back({place + ".spheres", static_cast<double>(rock.spheres.size())});
  facts.push_back({place + ".filling_deviation_m", rock.deviation});
}

/// Named spheres first, then rocks, then streams: the order of ids.
void add_bodies(const ParticlesScene& particles, ParticleModel& model) {
  for (const auto& [name, sphere] : particles.spheres) model.spheres.push_back(sphere_of(particles, sphere));
  for (const auto& [name, scene] : particles.rocks) {
    BuiltRock built = build_rock(name, scene, density_of(particles, scene.material));
    built.rock.name = name;
    for (SphereInput& sphere : built.spheres) {
      sphere.material = static_cast<Index>(material_index(particles, scene.material));
      sphere.rock = static_cast<Index>(model.rocks.size());
      model.spheres.push_back(sphere);
    }
    if (!built.surface.positions.empty()) add_facts_of_filling(name, built, model.facts);
    model.rocks.push_back(built.rock);
    model.rock_surfaces.push_back(std::move(built.surface));
  }
  for (const auto& [name, stream] : particles.streams)
    for (SphereInput sphere : make_stream(stream, density_of(particles, stream.material))) {
      sphere.material = static_cast<Index>(material_index(particles, stream.material));
      sphere.area = disc_of(sphere.radius);
      model.spheres.push_back(sphere);
    }
}

/// A boundary that names no material gets the only one there is for it.
std::string boundary_material(const ParticlesScene& particles, const mesh::SurfacePart& part) {
  if (!part.material.empty()) return part.material;
  if (particles.materials.size() == 1) return particles.materials.front().first;
  throw core::ConfigError("the boundary `" + part.name +
                          "` names no material, and particles.materials has several");
}

std::vector<Index> materials_of_parts(const ParticlesScene& particles, const mesh::Surface& surface) {
  std::vector<Index> materials;
  for (const mesh::SurfacePart& part : surface.parts) {
    const std::string name = boundary_material(particles, part);
    const auto index = material_index(particles, name);
    if (index < 0)
      throw core::ConfigError("the boundary `" + part.name + "`: there is no material `" + name +
                              "` in particles.materials");
    for (const Body& body : bodies_of(particles))
      if (find_contact(particles, body.material, name) == nullptr)
        throw core::ConfigError(missing_contact_message(body.material, name));
    materials.push_back(static_cast<Index>(index));
  }
  return materials;
}

LawChoice::FrictionKind friction_kind(const ParticlesScene& particles) {
  auto kind = LawChoice::FrictionKind::none;
  for (const ContactScene& contact : particles.contacts) {
    if (!contact.friction) continue;
    if (contact.friction->decay_speed) return LawChoice::FrictionKind::falling;
    kind = LawChoice::FrictionKind::constant;
  }
  return kind;
}

LawChoice::Rolling rolling_kind(const ParticlesScene& particles) {
  for (const ContactScene& contact : particles.contacts) {
    if (!contact.rolling) continue;
    return std::holds_alternative<ConstantTorqueScene>(contact.rolling->kind)
               ? LawChoice::Rolling::constant_torque
               : LawChoice::Rolling::elastic_plastic;
  }
  return LawChoice::Rolling::none;
}

}  // namespace

std::vector<Material> materials_of(const ParticlesScene& particles) {
  std::vector<Material> materials;
  for (const auto& [name, material] : particles.materials) materials.push_back(material_of(name, material));
  return materials;
}

namespace {
LawChoice::Normal normal_kind(const HertzScene& law) {
  return law.loss == HertzScene::Loss::hysteretic ? LawChoice::Normal::hysteretic_hertz
                                                  : LawChoice::Normal::hertz;
}
LawChoice::Normal normal_kind(const LinearScene&) {
  return LawChoice::Normal::linear;
}
LawChoice::Normal normal_kind(const FoundationScene&) {
  return LawChoice::Normal::foundation;
}

/// Light nodes answer to the jump of the force where two minima change their ranks; a boundary at rest does not.
ContactRule contact_rule_of(const ParticlesScene& particles, const BuildContext& context) {
  using Rule = ParticlesScene::FeatureRule;
  if (particles.contact_rule == Rule::automatic)
    return context.moved_by_structure ? ContactRule::tangent_plane : ContactRule::local_minima;
  return particles.contact_rule == Rule::local_minima ? ContactRule::local_minima
                                                      : ContactRule::tangent_plane;
}

}  // namespace

LawChoice law_of(const ParticlesScene& particles, const BuildContext& context) {
  return {.normal = particles.contacts.empty() ? LawChoice::Normal::hertz
                                               : std::visit([](const auto& law) { return normal_kind(law); },
                                                            particles.contacts.front().normal),
          .friction = friction_kind(particles),
          .rolling = rolling_kind(particles),
          .ledger = context.ledger};
}

ParticleModel build_model(const ParticlesScene& particles, const mesh::Surface& surface,
                          const BuildContext& context) {
  ParticleModel model;
  add_bodies(particles, model);
  for (const auto& [name, plane] : particles.planes)
    model.planes.push_back({.name = name,
                            .point = triple_of(plane.point),
                            .normal = triple_of(plane.normal.normalized()),
                            .material = static_cast<Index>(material_index(particles, plane.material))});
  if (!surface.parts.empty()) model.boundary = Boundary(surface, materials_of_parts(particles, surface));
  for (std::size_t k = 0; k < surface.parts.size(); ++k)
    for (const auto& [name, boundary] : particles.boundaries)
      if (boundary.velocity && name == surface.parts[k].name)
        model.boundary.set_velocity(static_cast<Index>(k), triple_of(*boundary.velocity));
  for (const auto& [name, gate] : particles.gates) model.gates.push_back(make_gate(name, gate));
  const BodyNames names(particles, model.spheres);
  check_overlaps(model.spheres, [&](Index sphere) { return names.key(sphere); });
  model.pairs = pair_table(particles);
  model.law = law_of(particles, context);
  if (particles.gravity) model.gravity = triple_of(*particles.gravity);
  model.contact_rule = contact_rule_of(particles, context);
  if (particles.implicit_contact)
    model.implicit_contact = {.tolerance = particles.implicit_contact->tolerance,
                              .most_sweeps = static_cast<int>(particles.implicit_contact->most_sweeps)};
  model.may_be_unstable = particles.unstable_step == ParticlesScene::UnstableStep::allowed;
  model.step = context.step;
  model.threads = context.threads;
  return model;
}

}  // namespace talus::dem
