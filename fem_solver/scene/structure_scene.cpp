#include "fem_solver/scene/structure_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/scene/plausible.hpp"
#include "interface_mesh/ring_panel.hpp"

namespace talus::fem {

namespace {

/// A panel of rings says itself how they are wound; others have to be told.
void complete_rings(core::Fields& fields, const ShapeScene& shape, RingScene& ring) {
  const auto* net = std::get_if<mesh::RingNetScene>(&shape);
  const bool given = ring.windings || ring.wire_diameter || ring.inner_diameter;
  fields.rule(!net || !given, "ring", "has its windings and diameters from `ring_net`: leave them out here");
  fields.rule(net || (ring.windings && ring.wire_diameter && ring.inner_diameter), "ring",
              "needs `windings`, `wire_diameter` and `inner_diameter`, as the part is no `ring_net`");
  if (!net || given || !net->panel.is_complete() || !(net->inner_diameter > 0)) return;
  ring.windings = net->windings;
  ring.wire_diameter = net->wire_diameter;
  ring.inner_diameter = net->inner_diameter;
  constexpr double most_misfit = 0.01;
  const double misfit = mesh::misfit(net->inner_diameter, make_panel(net->panel));
  fields.rule(
      misfit <= most_misfit, "ring_net",
      fmt::format("must have a size of whole rings to be made of them, but its rings of {:g} m would stand "
                  "{:.3g} % too far apart or too near",
                  net->inner_diameter, 100 * misfit));
}

bool has_area(const ElementScene& element) {
  return std::visit(
      [](const auto& scene) { return std::is_base_of_v<AxialScene, std::decay_t<decltype(scene)>>; },
      element);
}

}  // namespace

void describe(core::Fields& fields, PartScene& part) {
  part.place = fields.place();
  describe_shape(fields, part.shape);
  if (has_no_element(part)) return;
  describe_element(fields, part.element);
  if (auto* ring = std::get_if<RingScene>(&part.element)) complete_rings(fields, part.shape, *ring);
  fields.rule(!std::holds_alternative<mesh::HexagonalNetScene>(part.shape) || has_area(part.element),
              "hexagonal_net", "has twists of two wires and needs an element with `area`, such as `cable`");
  fields.optional(
      "gravity", part.gravity,
      {.unit = "m/s^2",
       .help = "of this part, in place of the structure's: `[0 m/s^2, 0 m/s^2, 0 m/s^2]` for none",
       .plausible = core::plausible::gravity});
  fields.section("damping", part.damping, "of this part, in place of the structure's");
}

void describe(core::Fields& fields, DampingScene& damping) {
  fields.with_default(
      "mass", damping.mass,
      {.unit = "1/s", .range = core::not_negative, .help = "force against velocity, per mass"});
  fields.with_default("stiffness", damping.stiffness,
                      {.unit = "s",
                       .range = core::not_negative,
                       .help = "force against strain rate, per stiffness; lowers the step limit"});
}

void describe(core::Fields& fields, WeldScene& weld) {
  fields.required("tolerance", weld.tolerance,
                  {.unit = "m",
                   .range = core::not_negative,
                   .help = "nodes of different parts closer than this become one"});
}

void describe(core::Fields&, ExplicitScene&) {}

void describe(core::Fields& fields, MassScalingScene& scaling) {
  fields.required(
      "step", scaling.step,
      {.unit = "s",
       .range = core::positive,
       .help = "light nodes get the mass that makes this step stable; the added mass is reported"});
}

void describe(core::Fields& fields, ImplicitScene& method) {
  fields.with_default(
      "spectral_radius", method.spectral_radius,
      {.range = core::fraction,
       .help = "at infinite frequency: 1 keeps every motion, 0 removes what a step cannot resolve"});
  fields.with_default(
      "tolerance", method.tolerance,
      {.range = {.low = 1e-14, .high = 1e-2}, .help = "largest residual force over the largest force"});
}

void describe(core::Fields& fields, StaticScene& method) {
  fields.with_default("steps", method.steps,
                      {.range = {.low = 1, .high = 1e6}, .help = "load steps over time.end"});
  fields.with_default(
      "tolerance", method.tolerance,
      {.range = {.low = 1e-14, .high = 1e-2}, .help = "largest residual force over the largest force"});
}

void describe(core::Fields& fields, EquilibriumScene& equilibrium) {
  fields.with_default(
      "steps", equilibrium.steps,
      {.range = {.low = 1, .high = 1e6}, .help = "in which weight comes on, and loads without a table do"});
  fields.with_default(
      "tolerance", equilibrium.tolerance,
      {.range = {.low = 1e-14, .high = 1e-2}, .help = "largest residual force over the largest force"});
}

void describe(core::Fields& fields, RelaxationScene& relaxation) {
  fields.with_default("steps", relaxation.steps,
                      {.range = {.low = 1, .high = 1e9}, .help = "that it may take at most"});
  fields.with_default(
      "tolerance", relaxation.tolerance,
      {.range = {.low = 1e-14, .high = 1e-2}, .help = "largest force left over the largest force"});
}

void describe(core::Fields& fields, AfterScene& after) {
  fields.required(
      "state", after.state,
      {.help = "structure_state.h5 of a result of the same structure, which a run writes with `output: "
               "{final_state: {}}`"});
  fields.choice("motion", after.motion, {"comes_to_rest", "goes_on"},
                "whether it falls into place first, as by `relaxation`, or goes on with its velocities");
  describe(fields, static_cast<RelaxationScene&>(after));
}

void describe(core::Fields& fields, StartScene& start) {
  fields.one_of(
      start.from,
      {{"equilibrium",
        "at rest under weight, prestress, and loads as they are at time 0, by Newton's iteration"},
       {"relaxation",
        "the same by letting the structure fall into place: also where parts hang slack or have no "
        "stiffness"},
       {"after", "where another run has left the same structure, for the next impact without repair"}});
}

namespace {

bool constrained_slides(const StructureScene& structure) {
  return std::ranges::any_of(structure.slides, [](const NamedSlide& slide) {
    return std::holds_alternative<ConstraintSlideScene>(slide.second.method);
  });
}

}  // namespace

void describe(core::Fields& fields, StructureScene& structure) {
  fields.section("solver", structure.solver,
                 "the program that plays the structure's part, and how it is started");
  fields.section("mesh_file", structure.mesh_file,
                 "one mesh of many parts, which take its groups by `group` and share its nodes");
  fields.rule(!structure.mesh_file || !structure.mesh_file->part, "mesh_file.part",
              "does not belong here: each part takes its own, by `group: {name: ...}`");
  fields.map("parts", structure.parts,
             "nets, ropes, posts and membranes by name: a shape and an element each", 1);
  const auto takes_group = [](const auto& part) {
    return std::holds_alternative<GroupScene>(part.second.shape);
  };
  const bool grouped = std::ranges::any_of(structure.parts, takes_group);
  fields.rule(!grouped || structure.mesh_file, "parts",
              "take a `group`, which needs `structure.mesh_file` to take it from");
  fields.rule(grouped || !structure.mesh_file, "mesh_file",
              "is taken by no part: write `group: {name: ...}` as a part's shape");
  fields.section("weld", structure.weld, "joins parts where their nodes coincide");
  fields.map("slides", structure.slides, "nodes that run along ropes of bars or cables, by name");
  fields.map("obstacles", structure.obstacles, "what nodes run against, such as the ground, by name");
  fields.map("node_sets", structure.node_sets, "nodes by name, for supports, loads and ropes");
  fields.list("supports", structure.supports, "nodes whose motion is given");
  fields.list("loads", structure.loads, "forces on nodes");
  fields.list("point_masses", structure.point_masses, "masses on nodes");
  fields.list("initial_displacements", structure.initial_displacements, "where nodes are at the start");
  fields.list("initial_velocities", structure.initial_velocities, "velocities of nodes at the start");
  fields.optional(
      "gravity", structure.gravity,
      {.unit = "m/s^2", .help = "acceleration of free fall", .plausible = core::plausible::gravity});
  describe_history(fields, "gravity_over_time", structure.gravity_over_time);
  const bool weighs = structure.gravity || std::ranges::any_of(structure.parts, [](const auto& part) {
                        return part.second.gravity.has_value();
                      });
  fields.rule(structure.gravity_over_time.empty() || weighs, "gravity_over_time",
              "needs `gravity` beside it");
  fields.section("damping", structure.damping,
                 "of all parts that name none of their own, and of point masses");
  fields.section("start", structure.start,
                 "where the structure is at time 0; as its shapes are written where absent");
  fields.rule(
      !structure.start || !constrained_slides(structure) ||
          std::holds_alternative<EquilibriumScene>(structure.start->from),
      "start",
      "by `relaxation` or `after` knows no `slides` with `constraint`: take `equilibrium`, or `penalty`");
  const auto* after = structure.start ? std::get_if<AfterScene>(&structure.start->from) : nullptr;
  fields.rule(
      !after || after->motion == AfterScene::Motion::comes_to_rest || structure.initial_velocities.empty(),
      "initial_velocities", "contradict `start.after.motion: goes_on`, which has velocities of its own");
  fields.rule(!structure.start || structure.initial_displacements.empty(), "initial_displacements",
              "contradict `start`, which finds where the nodes are");
  fields.one_of(structure.method,
                {{"explicit", "central differences; what a scene gets that names no method"},
                 {"implicit", "generalised-alpha method with Newton's iteration"},
                 {"static", "equilibrium; what has no `over_time` grows linearly up to time.end"}});
  fields.rule(!structure.start || !std::holds_alternative<StaticScene>(structure.method), "start",
              "is for runs through time; `static` itself finds the equilibrium");
  const bool constrained = constrained_slides(structure);
  const auto* implicit = std::get_if<ImplicitScene>(&structure.method);
  fields.rule(!constrained || !implicit || implicit->spectral_radius < 1, "implicit.spectral_radius",
              "has to be below 1 where `slides` hold by constraints: at 1 their forces ring without end");
  const bool jumps = std::ranges::any_of(structure.supports, [](const SupportScene& support) {
    return support.displacement && !support.displacement->isZero(0) && support.over_time.empty();
  });
  fields.rule(!jumps || std::holds_alternative<StaticScene>(structure.method), "supports",
              "move by a `displacement` without `over_time`, which in a run through time would be a jump; "
              "write how it "
              "grows, such as `over_time: [[0 s, 0], [0.1 s, 1]]`");
  fields.section("mass_scaling", structure.mass_scaling,
                 "mass on light nodes, for a longer explicit step at the price of slower waves");
  fields.rule(!structure.mass_scaling || is_explicit(structure.method), "mass_scaling",
              "is for explicit runs: others have no limit");
  fields.optional("step", structure.step,
                  {.unit = "s",
                   .range = core::positive,
                   .help = "the structure's own step; `time.step` where absent, or half of the limit where "
                           "that is absent too"});
  fields.choice("unstable_step", structure.unstable_step, {"refused", "allowed"},
                "what happens to an explicit step above the limit of stability");
}

}  // namespace talus::fem
