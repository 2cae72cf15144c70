#include "dem_solver/scene/contact_scene.hpp"

#include "core/scene/plausible.hpp"

namespace talus::dem {

namespace {
constexpr core::Range restitution_range{.low = 0, .high = 1, .low_included = false};
constexpr core::Range poisson_range{.low = -1, .high = 0.5, .low_included = false};
constexpr const char* restitution_help =
    "rebound over approach speed, the same at any speed and size, for as long as the step is short";
constexpr const char* hysteretic_help =
    "root of the energy that comes back over what went in, for any number of contacts of a body";
}  // namespace

void describe(core::Fields& fields, MaterialScene& material) {
  fields.optional("density", material.density,
                  {.unit = "kg/m^3",
                   .range = core::positive,
                   .help = "needed for spheres and rocks; boundaries have none",
                   .plausible = core::plausible::density});
  fields.required("youngs_modulus", material.youngs_modulus,
                  {.unit = "Pa",
                   .range = core::positive,
                   .help = "of the contact",
                   .plausible = core::plausible::contact_modulus});
  fields.required("poissons_ratio", material.poissons_ratio,
                  {.range = poisson_range, .help = "of the contact"});
}

void describe(core::Fields& fields, HertzScene& law) {
  fields.required("restitution", law.restitution, {.range = restitution_range, .help = restitution_help});
  fields.choice(
      "loss", law.loss, {"dashpot", "hysteretic"},
      "how energy is lost: by a dashpot, or by unloading on a steeper curve, which does not depend on how "
      "many contacts a body has");
}

void describe(core::Fields& fields, FoundationScene& law) {
  fields.required("stiffness_per_area", law.stiffness_per_area,
                  {.unit = "Pa/m",
                   .range = core::positive,
                   .help = "pressure over overlap; of an elastic layer E/((1 - v^2) thickness)",
                   .plausible = core::plausible::foundation});
  fields.with_default("tangential_ratio", law.tangential_ratio,
                      {.range = core::positive, .help = "tangential over normal stiffness"});
  fields.required("restitution", law.restitution, {.range = restitution_range, .help = hysteretic_help});
}

void describe(core::Fields& fields, LinearScene& law) {
  fields.required("stiffness", law.stiffness,
                  {.unit = "N/m",
                   .range = core::positive,
                   .help = "normal force over overlap",
                   .plausible = core::plausible::stiffness});
  fields.with_default("tangential_ratio", law.tangential_ratio,
                      {.range = core::positive, .help = "tangential over normal stiffness"});
  fields.required("restitution", law.restitution, {.range = restitution_range, .help = restitution_help});
}

void describe(core::Fields& fields, FrictionScene& friction) {
  fields.optional("coefficient", friction.coefficient,
                  {.range = core::not_negative,
                   .help = "Coulomb's coefficient, at rest and sliding alike",
                   .plausible = core::plausible::friction});
  fields.optional("at_rest", friction.at_rest,
                  {.range = core::not_negative,
                   .help = "coefficient at rest, instead of `coefficient`",
                   .plausible = core::plausible::friction});
  fields.optional("sliding", friction.sliding,
                  {.range = core::not_negative,
                   .help = "coefficient of fast sliding",
                   .plausible = core::plausible::friction});
  fields.optional(
      "decay_speed", friction.decay_speed,
      {.unit = "m/s", .range = core::positive, .help = "sliding speed at which 63 % of the fall is done"});
  const bool falls = friction.at_rest && friction.sliding && friction.decay_speed;
  const bool names_falling = friction.at_rest || friction.sliding || friction.decay_speed;
  fields.rule(friction.coefficient ? !names_falling : falls, "coefficient",
              "needs either `coefficient`, or all of `at_rest`, `sliding` and `decay_speed`");
}

void describe(core::Fields& fields, ConstantTorqueScene& rolling) {
  fields.required("coefficient", rolling.coefficient,
                  {.range = core::not_negative,
                   .help = "torque over normal force and reduced radius",
                   .plausible = core::plausible::friction});
}

void describe(core::Fields& fields, ElasticPlasticScene& rolling) {
  fields.required("coefficient", rolling.coefficient,
                  {.range = core::not_negative,
                   .help = "largest torque over normal force and reduced radius",
                   .plausible = core::plausible::friction});
  fields.with_default("damping", rolling.damping,
                      {.range = core::not_negative, .help = "rolling damping over critical"});
}

void describe(core::Fields& fields, RollingScene& rolling) {
  fields.one_of(rolling.kind, {{"constant_torque", "a torque of constant size (Ai et al. 2011, type A)"},
                               {"elastic_plastic", "spring, slider and dashpot (Ai et al. 2011, type C)"}});
}

void describe(core::Fields& fields, ContactScene& contact) {
  fields.required("between", contact.between, {.help = "the two materials, equal ones for their own kind"});
  fields.rule(contact.between.size() == 2, "between", "needs two materials");
  fields.one_of(contact.normal,
                {{"hertz", "Hertz's law with constant restitution"},
                 {"linear", "linear spring and dashpot"},
                 {"foundation",
                  "every sphere of a rock carries its share of the surface: force and rebound do not "
                  "depend on how the rock is filled"}});
  fields.section("friction", contact.friction,
                 "Coulomb friction with a tangential spring; absent: frictionless, and nothing turns");
  fields.section("rolling", contact.rolling, "rolling resistance; absent: none");
  fields.rule(contact.friction || !contact.rolling, "rolling", "needs `friction`, which turns the spheres");
}

}  // namespace talus::dem
