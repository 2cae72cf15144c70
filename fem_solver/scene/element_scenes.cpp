#include "fem_solver/scene/element_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/scene/plausible.hpp"

namespace talus::fem {
namespace {

void describe_breaking_load(core::Fields& fields, std::optional<double>& load) {
  fields.optional(
      "breaking_load", load,
      {.unit = "N",
       .range = core::positive,
       .help = "known strength, for the utilisation that `output.largest_forces` tells; nothing breaks "
               "by it",
       .plausible = core::plausible::strength_in_force});
}

void describe_axial(core::Fields& fields, AxialScene& axial) {
  fields.required(
      "area", axial.area,
      {.unit = "m^2", .range = core::positive, .help = "cross-section", .plausible = core::plausible::area});
  fields.required("density", axial.density,
                  {.unit = "kg/m^3",
                   .range = core::positive,
                   .help = "mass over volume",
                   .plausible = core::plausible::density});
  fields.required("youngs_modulus", axial.youngs_modulus,
                  {.unit = "Pa",
                   .range = core::positive,
                   .help = "between Green-Lagrange strain and second Piola-Kirchhoff stress",
                   .plausible = core::plausible::modulus});
  fields.with_default("prestress", axial.prestress,
                      {.unit = "Pa",
                       .help = "second Piola-Kirchhoff stress of the reference state, tension positive",
                       .plausible = core::plausible::prestress});
  describe_breaking_load(fields, axial.breaking_load);
}

}  // namespace

void describe(core::Fields& fields, BarScene& bar) {
  describe_axial(fields, bar);
  fields.optional(
      "second_moment", bar.second_moment,
      {.unit = "m^4",
       .range = core::positive,
       .help =
           "of the section about its weak axis: `output.largest_forces` then compares the compression "
           "with the load at which an element that is hinged at both ends buckles; nothing buckles by it"});
}
void describe(core::Fields& fields, BreaksScene& breaks) {
  fields.optional("force", breaks.force,
                  {.unit = "N",
                   .range = core::positive,
                   .help = "axial force above which an element is lost",
                   .plausible = core::plausible::strength_in_force});
  fields.optional(
      "strain", breaks.strain,
      {.range = core::positive, .help = "change of length over reference length above which it is lost"});
  fields.optional("work", breaks.work,
                  {.unit = "J",
                   .range = core::positive,
                   .help = "stored and dissipated in an element before it is lost"});
  fields.rule(breaks.force || breaks.strain || breaks.work, "force",
              "needs one of `force`, `strain` and `work`");
}
void describe(core::Fields& fields, CableScene& cable) {
  describe_axial(fields, cable);
  fields.section("breaks", cable.breaks, "elements that bear more are lost; none are where absent");
}

void describe(core::Fields& fields, FrictionAtScene& friction) {
  describe_selection(fields, friction.where);
  fields.optional("coefficient", friction.coefficient,
                  {.range = core::not_negative,
                   .help = "of the capstan equation at these nodes; 0 lets the rope run freely",
                   .plausible = core::plausible::friction});
  fields.with_default("clamped", friction.clamped, {.help = "nothing slips through these nodes"});
  fields.rule(friction.clamped != friction.coefficient.has_value(), "coefficient",
              "needs one of `coefficient` and `clamped: true`");
}

void describe(core::Fields& fields, SlidingCableScene& rope) {
  describe_axial(fields, rope);
  fields.optional(
      "slider_size", rope.slider_size,
      {.unit = "m",
       .range = core::positive,
       .help = "segments shorter than this hold the slider as its fitting would; a hundredth of the "
               "shortest segment where absent"});
  fields.optional("friction", rope.friction,
                  {.range = core::positive,
                   .help = "coefficient of the capstan equation; none where absent",
                   .plausible = core::plausible::friction});
  fields.list("friction_at", rope.friction_at,
              "nodes with a friction of their own, such as post heads and shackles; later entries count over "
              "earlier ones");
  fields.section("breaks", rope.breaks, "a rope that bears more is lost as a whole; it is not where absent");
}

void describe(core::Fields& fields, ElasticPlasticCableScene& rope) {
  describe_axial(fields, rope);
  fields.required("yield_stress", rope.yield_stress,
                  {.unit = "Pa",
                   .range = core::positive,
                   .help = "second Piola-Kirchhoff stress of first yield",
                   .plausible = core::plausible::strength});
  fields.with_default("hardening", rope.hardening,
                      {.unit = "Pa",
                       .range = core::not_negative,
                       .help = "rise of the yield stress over plastic strain",
                       .plausible = core::plausible::strength});
  fields.section("breaks", rope.breaks, "elements that bear more are lost; none are where absent");
  fields.rule(!(rope.prestress > rope.yield_stress), "prestress",
              fmt::format("must not exceed yield_stress, but is {} Pa", rope.prestress));
}

void describe(core::Fields& fields, EndStopScene& stop) {
  fields.required("stiffness", stop.stiffness,
                  {.unit = "N/m",
                   .range = core::positive,
                   .help = "past the end of travel",
                   .plausible = core::plausible::stiffness});
  fields.required("width", stop.width,
                  {.unit = "m", .range = core::positive, .help = "of the elongation over which it comes in"});
}

void describe(core::Fields& fields, BrakeScene& brake) {
  fields.required(
      "table", brake.table,
      {.unit = "m, N", .help = "pairs of elongation and force, from (0, 0); the last one ends the travel"});
  fields.required("mass_per_length", brake.mass_per_length,
                  {.unit = "kg/m",
                   .range = core::positive,
                   .help = "of the reference length",
                   .plausible = core::plausible::mass_per_length});
  double travel = 0, force = 0;
  for (const auto& [elongation, at] : brake.table) {
    travel = std::max(travel, elongation);
    force = std::max(force, at);
  }
  constexpr double longest = 1000, weakest = 0.1;  // m, N
  fields.rule(
      brake.table.empty() || (travel < longest && force > weakest), "table",
      fmt::format(
          "reaches {:g} m and {:g} N, which no brake does: millimetres are written mm, kilonewtons kN",
          travel, force));
  describe_breaking_load(fields, brake.breaking_load);
  fields.section("end_stop", brake.end_stop,
                 "what happens past the travel; the initial stiffness where absent");
  fields.section("breaks", brake.breaks, "brakes that bear more are lost; none are where absent");
}

void describe(core::Fields& fields, RingBreaksScene& breaks) {
  fields.optional(
      "force", breaks.force,
      {.unit = "N",
       .range = core::positive,
       .help = "along the ring, half of what a chain of rings bears; as calibrated where absent"});
}

void describe(core::Fields& fields, RingScene& ring) {
  fields.optional("windings", ring.windings,
                  {.range = {.low = 1, .high = 100},
                   .help = "how often the wire goes round; a `ring_net` says it itself"});
  fields.optional("wire_diameter", ring.wire_diameter,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "diameter of a single wire; a `ring_net` says it itself"});
  fields.optional(
      "inner_diameter", ring.inner_diameter,
      {.unit = "m", .range = core::positive, .help = "of a round ring; a `ring_net` says it itself"});
  fields.with_default("density", ring.density,
                      {.unit = "kg/m^3",
                       .range = core::positive,
                       .help = "mass over volume of the wire",
                       .plausible = core::plausible::density});
  fields.with_default("strength", ring.strength,
                      {.unit = "Pa",
                       .range = core::positive,
                       .help = "of the wire; tensions of rings are in proportion to it",
                       .plausible = core::plausible::strength});
  describe_breaking_load(fields, ring.breaking_load);
  fields.section("breaks", ring.breaks, "rings that bear more are lost; none are where absent");
}

void describe(core::Fields& fields, IsotropicSheet& sheet) {
  fields.required("youngs_modulus", sheet.youngs_modulus,
                  {.unit = "Pa",
                   .range = core::positive,
                   .help = "in plane stress",
                   .plausible = core::plausible::modulus});
  fields.required("poissons_ratio", sheet.poissons_ratio,
                  {.range = {.low = -1, .high = 1, .low_included = false, .high_included = false},
                   .help = "contraction across a pull",
                   .plausible = core::plausible::contraction});
}

void describe(core::Fields& fields, OrthotropicScene& scene) {
  OrthotropicSheet& sheet = scene.sheet;
  fields.required("youngs_modulus_x", sheet.youngs_modulus_x,
                  {.unit = "Pa",
                   .range = core::positive,
                   .help = "along the material axis",
                   .plausible = core::plausible::modulus});
  fields.required("youngs_modulus_y", sheet.youngs_modulus_y,
                  {.unit = "Pa",
                   .range = core::positive,
                   .help = "across the material axis",
                   .plausible = core::plausible::modulus});
  fields.required("poissons_ratio_xy", sheet.poissons_ratio_xy,
                  {.help = "contraction along x under a pull along y: C12 = v_xy E_x/(1 - v_xy v_yx)"});
  fields.optional("poissons_ratio_yx", scene.poissons_ratio_yx,
                  {.help = "the other one, checked: v_xy/E_y = v_yx/E_x"});
  fields.required("shear_modulus", sheet.shear_modulus,
                  {.unit = "Pa",
                   .range = core::positive,
                   .help = "between the material axes",
                   .plausible = core::plausible::modulus});
  const double limit = std::sqrt(sheet.youngs_modulus_y / sheet.youngs_modulus_x);
  fields.rule(
      !(std::abs(sheet.poissons_ratio_xy) >= limit), "poissons_ratio_xy",
      fmt::format(
          "must be smaller than sqrt(E_y/E_x) = {:.6g} in magnitude for a positive definite stiffness, "
          "but is {}",
          limit, sheet.poissons_ratio_xy));
  if (!scene.poissons_ratio_yx) return;
  const double expected = sheet.poissons_ratio_xy * sheet.youngs_modulus_x / sheet.youngs_modulus_y;
  fields.rule(is_poisson_pair(sheet, *scene.poissons_ratio_yx), "poissons_ratio_yx",
              fmt::format("must be v_xy E_x/E_y = {:.6g} for a symmetric stiffness, but is {}", expected,
                          *scene.poissons_ratio_yx));
}

void describe(core::Fields& fields, MembranePrestressScene& prestress) {
  fields.with_default(
      "xx", prestress.stress.xx,
      {.unit = "Pa", .help = "along the material axis", .plausible = core::plausible::prestress});
  fields.with_default(
      "yy", prestress.stress.yy,
      {.unit = "Pa", .help = "across the material axis", .plausible = core::plausible::prestress});
  fields.with_default("xy", prestress.stress.xy,
                      {.unit = "Pa", .help = "shear", .plausible = core::plausible::prestress});
}

void describe(core::Fields& fields, TensionFieldScene& field) {
  fields.choice("wrinkle_direction", field.wrinkle_direction, {"iterated", "principal"},
                "iterated: exact, no compression; principal: across the smaller principal trial stress");
}

namespace {

bool is_isotropic(const OrthotropicSheet& sheet) {
  constexpr double written = 1e-6;  // of a modulus: the digits of a scene
  const auto near = [](double a, double b) { return std::abs(a - b) <= written * std::abs(b); };
  return near(sheet.youngs_modulus_x, sheet.youngs_modulus_y) &&
         near(sheet.shear_modulus, sheet.youngs_modulus_x / (2 * (1 + sheet.poissons_ratio_xy)));
}

/// What of a sheet has a direction; empty where nothing has.
std::string directed(const MembraneScene& membrane) {
  if (const auto* scene = std::get_if<OrthotropicScene>(&membrane.elasticity);
      scene && !is_isotropic(scene->sheet))
    return "the stiffness";
  const PlaneStress<double>& stress = membrane.prestress.stress;
  return stress.xx != stress.yy || stress.xy != 0 ? "the prestress" : "";
}

}  // namespace

void describe(core::Fields& fields, MembraneScene& membrane) {
  fields.required("thickness", membrane.thickness,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "of the homogenised sheet",
                   .plausible = core::plausible::thickness});
  fields.required("density", membrane.density,
                  {.unit = "kg/m^3",
                   .range = core::positive,
                   .help = "mass over area times thickness",
                   .plausible = core::plausible::density});
  fields.one_of(membrane.elasticity, {{"isotropic", "the same stiffness in all directions"},
                                      {"orthotropic", "two directions, after Münsch and Reinhardt"}});
  fields.optional(
      "material_axis", membrane.material_axis,
      {.help = "x direction of the material, projected on each triangle; absent: no direction is special"});
  std::optional<MembranePrestressScene> prestress;
  fields.section("prestress", prestress, "second Piola-Kirchhoff stress of the reference state");
  if (prestress) membrane.prestress = *prestress;
  fields.section("tension_field", membrane.tension_field,
                 "the sheet wrinkles or goes slack instead of carrying compression");
  fields.rule(!membrane.material_axis || membrane.material_axis->norm() > 0, "material_axis",
              "must not be zero");
  const std::string what = directed(membrane);
  fields.rule(membrane.material_axis || what.empty(), "material_axis",
              fmt::format("needs `material_axis`, as {} differs by direction: write the x direction of the "
                          "material, such as `material_axis: [1, 0, 0]`",
                          what));
}

void describe(core::Fields& fields, UserElementScene& element) {
  fields.required("name", element.name, {.help = "under which the program knows it"});
  fields.with_default("parameters", element.parameters, {.help = "numbers that it is made with"});
}

void describe_element(core::Fields& fields, ElementScene& element) {
  fields.one_of(
      element,
      {{"bar", "carries tension and compression"},
       {"cable", "carries tension only"},
       {"sliding_cable", "one rope that runs through all its nodes, tension only"},
       {"elastic_plastic_cable", "carries tension only, yields and hardens"},
       {"brake", "force over elongation from a table, plastic, with an end stop"},
       {"ring", "closed rings of wire that run freely through the nodes where their neighbours touch them"},
       {"membrane", "a homogenised net or sheet of triangles in plane stress"},
       {"user_element", "one that a program of its own has (docs/extending_structure.md)"}});
}

}  // namespace talus::fem
