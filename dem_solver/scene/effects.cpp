#include "dem_solver/scene/effects.hpp"

#include "dem_solver/scene/scene_rules.hpp"
#include "dem_solver/scene/step_limits.hpp"

namespace talus::dem {

namespace {

/// The first contact entry for which `has` holds, as "particles.contacts[2]"; empty where there is none.
template <class Has>
std::string contact_with(const ParticlesScene& particles, Has&& has) {
  for (std::size_t k = 0; k < particles.contacts.size(); ++k)
    if (has(particles.contacts[k])) return "particles.contacts[" + std::to_string(k) + "]";
  return {};
}

bool has_several_bodies(const ParticlesScene& particles) {
  std::int64_t bodies = 0;
  for (const Body& body : bodies_of(particles)) bodies += body.count;
  return bodies > 1;
}

ParticleEffect effect(const char* name, const std::string& named_by, const char* would_need) {
  return {name, !named_by.empty(), named_by.empty() ? would_need : named_by + " is given"};
}

/// An effect that acts on bodies at rest as well, where it does no work: a force that turns or moves nothing is not seen
/// in any line but that of what it would have moved.
ParticleEffect holding(ParticleEffect effect, const std::string& key, const char* moved_line) {
  effect.key = key;
  effect.ledger_line = moved_line;
  effect.may_hold = true;
  return effect;
}

ParticleEffect lifting(ParticleEffect effect, const char* key, const char* limit) {
  effect.key = key;
  effect.limit = limit;
  return effect;
}

}  // namespace

std::vector<ParticleEffect> effects_of(const ParticlesScene& particles, const EffectContext& context) {
  const auto friction = contact_with(particles, [](const ContactScene& c) { return c.friction.has_value(); });
  const auto falling =
      contact_with(particles, [](const ContactScene& c) { return c.friction && c.friction->decay_speed; });
  const auto rolling = contact_with(particles, [](const ContactScene& c) { return c.rolling.has_value(); });
  const auto linear = contact_with(
      particles, [](const ContactScene& c) { return std::holds_alternative<LinearScene>(c.normal); });
  const auto hysteretic = contact_with(particles, [](const ContactScene& c) {
    const auto* hertz = std::get_if<HertzScene>(&c.normal);
    return hertz != nullptr && hertz->loss == HertzScene::Loss::hysteretic;
  });
  const auto foundation = contact_with(
      particles, [](const ContactScene& c) { return std::holds_alternative<FoundationScene>(c.normal); });
  const auto suffixed = [](const std::string& entry, const char* key) {
    return entry.empty() ? entry : entry + key;
  };
  return {
      holding(effect("gravity", particles.gravity ? "particles.gravity" : "", "particles.gravity is absent"),
              "particles.gravity", "particles.gravity_J"),
      effect("contacts between spheres", has_several_bodies(particles) ? "more than one body" : "",
             "there is one body only"),
      effect("rocks", particles.rocks.empty() ? "" : "particles.rocks", "particles.rocks is absent"),
      effect("planes", particles.planes.empty() ? "" : "particles.planes", "particles.planes is absent"),
      effect("boundary",
             !particles.boundaries.empty() ? "particles.boundaries"
             : context.has_interface       ? "interface"
                                           : "",
             "particles.boundaries and interface are absent"),
      lifting(effect("implicit contact", particles.implicit_contact ? "particles.implicit_contact" : "",
                     "particles.implicit_contact is absent"),
              "particles.implicit_contact", node_dashpot_limit),
      effect("linear contact law", suffixed(linear, ".linear"), "no contact names `linear`"),
      effect("contact law of surfaces", suffixed(foundation, ".foundation"), "no contact names `foundation`"),
      effect("hysteretic contacts", suffixed(hysteretic, ".hertz.loss"),
             "no contact names `loss: hysteretic`"),
      holding(effect("friction", suffixed(friction, ".friction"), "no contact names `friction`"),
              suffixed(friction, ".friction"), "particles.kinetic_rotation_J"),
      effect("rotation", suffixed(friction, ".friction"),
             "nothing turns the spheres: no contact names `friction`"),
      effect("falling friction coefficient", suffixed(falling, ".friction.decay_speed"),
             "no contact names `friction.decay_speed`"),
      holding(effect("rolling resistance", suffixed(rolling, ".rolling"), "no contact names `rolling`"),
              suffixed(rolling, ".rolling"), "particles.kinetic_rotation_J"),
      effect("gates", particles.gates.empty() ? "" : "particles.gates", "particles.gates is absent"),
      effect("energy ledger", context.has_output ? "output" : "", "output is absent"),
  };
}

}  // namespace talus::dem
