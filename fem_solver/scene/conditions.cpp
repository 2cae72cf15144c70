#include "fem_solver/scene/conditions.hpp"

#include <algorithm>

#include "core/scene/plausible.hpp"

namespace talus::fem {

void describe_history(core::Fields& fields, const char* key, std::vector<std::pair<double, double>>& points) {
  fields.with_default(
      key, points,
      {.unit = "s, ", .help = "pairs of time and factor, linear in between; 1 throughout where absent"});
  fields.rule(std::ranges::is_sorted(points, std::ranges::less_equal{}, &std::pair<double, double>::first) ||
                  std::ranges::adjacent_find(points, std::ranges::greater_equal{},
                                             &std::pair<double, double>::first) == points.end(),
              key, "needs times that increase");
}

void describe(core::Fields& fields, BoxScene& box) {
  fields.required("low", box.low, {.unit = "m", .help = "the corner with the smallest coordinates"});
  fields.required("high", box.high, {.unit = "m", .help = "the corner with the largest coordinates"});
  fields.rule((box.low.array() <= box.high.array()).all(), "high",
              "must not be below `low` in any direction");
}

void describe_selection(core::Fields& fields, NodeSelection& selection) {
  selection.place = fields.place();
  fields.optional("nodes", selection.nodes,
                  {.help = "a node set: `net.rim`, a part's name for all its nodes, or one of `node_sets`"});
  fields.optional("at", selection.at, {.unit = "m", .help = "the node at this point of the reference state"});
  fields.section("box", selection.box, "all nodes inside a box of the reference state, its faces included");
  const int ways =
      int(selection.nodes.has_value()) + int(selection.at.has_value()) + int(selection.box.has_value());
  fields.rule(ways == 1, "nodes", "needs exactly one of `nodes`, `at` and `box`");
}

void describe(core::Fields& fields, NodeSelection& selection) {
  describe_selection(fields, selection);
}

void describe(core::Fields& fields, SupportScene& support) {
  describe_selection(fields, support.where);
  fields.required("fix", support.fix, {.help = "directions that are held: letters of xyz"});
  fields.rule(!support.fix.empty() && support.fix.find_first_not_of("xyz") == std::string::npos, "fix",
              "must be made of the letters x, y and z, but is '" + support.fix + "'");
  fields.optional("displacement", support.displacement,
                  {.unit = "m", .help = "moves the held directions by this times `over_time`"});
  fields.optional("velocity", support.velocity,
                  {.unit = "m/s",
                   .help = "moves the held directions steadily from time 0 on",
                   .plausible = core::plausible::velocity});
  fields.rule(!support.velocity || !support.displacement, "velocity",
              "contradicts `displacement`: write one of them");
  describe_history(fields, "over_time", support.over_time);
  fields.rule(support.over_time.empty() || support.displacement, "over_time",
              "needs `displacement` beside it");
}

void describe(core::Fields& fields, LoadScene& load) {
  describe_selection(fields, load.where);
  fields.required("force", load.force, {.unit = "N", .help = "force on each of the nodes"});
  describe_history(fields, "over_time", load.over_time);
}

void describe(core::Fields& fields, PointMassScene& mass) {
  describe_selection(fields, mass.where);
  fields.required("mass", mass.mass,
                  {.unit = "kg",
                   .range = core::positive,
                   .help = "added to each of the nodes",
                   .plausible = core::plausible::point_mass});
}

void describe(core::Fields& fields, InitialDisplacementScene& initial) {
  describe_selection(fields, initial.where);
  fields.required("displacement", initial.displacement,
                  {.unit = "m", .help = "of each of the nodes at the start, from its shape"});
}

void describe(core::Fields& fields, InitialVelocityScene& initial) {
  describe_selection(fields, initial.where);
  fields.required(
      "velocity", initial.velocity,
      {.unit = "m/s", .help = "of each of the nodes at the start", .plausible = core::plausible::velocity});
}

}  // namespace talus::fem
