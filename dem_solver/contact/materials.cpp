#include "dem_solver/contact/materials.hpp"

#include "dem_solver/contact/restitution.hpp"

namespace talus::dem {

namespace {
double shear_modulus(const Material& m) noexcept {
  return m.youngs_modulus / (2 * (1 + m.poissons_ratio));
}
double normal_compliance(const Material& m) noexcept {
  return (1 - m.poissons_ratio * m.poissons_ratio) / m.youngs_modulus;
}
double shear_compliance(const Material& m) noexcept {
  return (2 - m.poissons_ratio) / shear_modulus(m);
}
}  // namespace

EffectiveModuli effective_moduli(const Material& a, const Material& b) noexcept {
  return {1 / (normal_compliance(a) + normal_compliance(b)), 1 / (shear_compliance(a) + shear_compliance(b))};
}

PairParameters pair_parameters(const HertzContact& contact, const EffectiveModuli& moduli) noexcept {
  return {.normal = Row{{moduli.normal, moduli.shear, hertz_damping_ratio(contact.restitution),
                         2 * std::sqrt(moduli.shear / moduli.normal)}},
          .friction = {},
          .rolling = {}};
}

PairParameters pair_parameters(const HystereticContact& contact, const EffectiveModuli& moduli) noexcept {
  return {.normal = Row{{moduli.normal, moduli.shear, contact.restitution * contact.restitution, 0}},
          .friction = {},
          .rolling = {}};
}

PairParameters pair_parameters(const FoundationContact& contact) noexcept {
  return {.normal = Row{{contact.stiffness_per_area, contact.tangential_ratio * contact.stiffness_per_area,
                         contact.restitution * contact.restitution, 0}},
          .friction = {},
          .rolling = {}};
}

PairParameters pair_parameters(const LinearContact& contact) noexcept {
  return {.normal = Row{{contact.stiffness, contact.tangential_ratio * contact.stiffness,
                         oscillator_damping_ratio(contact.restitution), std::sqrt(contact.tangential_ratio)}},
          .friction = {},
          .rolling = {}};
}

void set_friction(PairParameters& parameters, const FrictionCoefficients& friction) noexcept {
  const double inverse_decay = friction.decay_speed > 0 ? 1 / friction.decay_speed : 0;
  parameters.friction = Row{{friction.at_rest, friction.sliding, inverse_decay, 0}};
}

void set_rolling(PairParameters& parameters, const RollingCoefficients& rolling) noexcept {
  parameters.rolling = Row{{rolling.friction, rolling.damping, 0, 0}};
}

}  // namespace talus::dem
