#include "coupler/barrier/sheet.hpp"

#include <fmt/format.h>

#include "core/scene/plausible.hpp"
#include "core/scene/reader.hpp"
#include "coupler/barrier/components.hpp"

namespace talus::barrier {

namespace {
constexpr core::Range any_angle{.low = 0, .high = 1.5707964};
constexpr core::Range some{.low = 1, .high = 8};
}  // namespace

void describe(core::Fields& fields, PostSheet& posts) {
  fields.with_default("count", posts.count, {.range = {.low = 2, .high = 40}, .help = "posts of the row"});
  fields.with_default("spacing", posts.spacing,
                      {.unit = "m", .range = core::positive, .help = "from post to post"});
  fields.required("length", posts.length,
                  {.unit = "m", .range = core::positive, .help = "from foot to head"});
  fields.with_default(
      "lean", posts.lean,
      {.unit = "rad", .range = {.low = 0, .high = 1}, .help = "back up the slope, from its normal"});
  fields.with_default("foot_height", posts.foot_height,
                      {.unit = "m", .range = core::not_negative, .help = "of the hinge above the ground"});
  fields.required("profile", posts.profile, {.help = "such as HEA160; known: the table of components"});
  fields.rule(find_profile(posts.profile) != nullptr, "profile",
              fmt::format("there is no profile `{}`; known: {}", posts.profile, known_profiles()));
}

void describe(core::Fields& fields, NetSheet& net) {
  fields.required(
      "kind", net.kind,
      {.help = "name of a net of the table of components, or rings: `ring_7_3_300` has 7 windings of 3 mm "
               "wire, 300 mm wide"});
  fields.with_default("gap", net.gap,
                      {.unit = "m",
                       .range = core::positive,
                       .help = "between the net's edges and the posts' ends, at least: rings are whole"});
  fields.with_default(
      "cell_along", net.cell_along,
      {.unit = "m", .range = core::positive, .help = "of the membrane's mesh, along the row"});
  fields.with_default(
      "cell_across", net.cell_across,
      {.unit = "m", .range = core::positive, .help = "of the membrane's mesh, along the posts"});
  fields.rule(find_net(net.kind) != nullptr || find_ring_net(net.kind), "kind",
              fmt::format("there is no net `{}`; known: {}", net.kind, known_nets()));
}

void describe(core::Fields& fields, BrakeSheet& brakes) {
  fields.required("force", brakes.force,
                  {.unit = "N", .range = core::positive, .help = "of one brake at 0.1 m"});
  fields.required("travel", brakes.travel, {.unit = "m", .range = core::positive, .help = "until its stop"});
  fields.with_default("length", brakes.length,
                      {.unit = "m", .range = core::positive, .help = "of the device, beside its anchor"});
  fields.rule(brakes.travel > 0.1, "travel",
              "is to be longer than the 0.1 m after which a brake has its force");
}

void describe(core::Fields& fields, SupportRopeSheet& ropes) {
  fields.required("diameter", ropes.diameter, {.unit = "m", .range = core::positive, .help = "of one rope"});
  fields.with_default("number", ropes.number, {.range = some, .help = "side by side, above and below each"});
  fields.optional("friction", ropes.friction,
                  {.range = core::positive,
                   .help = "at post heads, feet and shackles (0.1 to 0.3); absent: none",
                   .plausible = core::plausible::friction});
  fields.section("brakes", ropes.brakes, "at both ends of each rope; absent: the ropes run to their anchors");
  check_rope(fields, "diameter", ropes.diameter);
}

void describe(core::Fields& fields, RetainingRopeSheet& ropes) {
  fields.required("diameter", ropes.diameter,
                  {.unit = "m", .range = core::positive, .help = "two ropes a post"});
  fields.required("upslope", ropes.upslope,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "from feet to anchors along the slope, midway between posts"});
  check_rope(fields, "diameter", ropes.diameter);
}

void describe(core::Fields& fields, LateralRopeSheet& ropes) {
  fields.required("diameter", ropes.diameter, {.unit = "m", .range = core::positive, .help = "of one rope"});
  fields.with_default(
      "beside", ropes.beside,
      {.unit = "m", .range = core::positive, .help = "from the edge posts to the anchors, along the row"});
  check_rope(fields, "diameter", ropes.diameter);
}

void describe(core::Fields& fields, BlockSheet& block) {
  fields.choice("form", block.form, {"eota_111", "eota_221"}, "test block of EAD 340059, cubic or flat");
  fields.required("mass", block.mass,
                  {.unit = "kg",
                   .range = core::positive,
                   .help = "of the block",
                   .plausible = core::plausible::rock_mass});
  fields.with_default("density", block.density,
                      {.unit = "kg/m^3",
                       .range = core::positive,
                       .help = "gives its size",
                       .plausible = core::plausible::density});
  fields.with_default("speed", block.speed,
                      {.unit = "m/s",
                       .range = core::positive,
                       .help = "down the slope",
                       .plausible = core::plausible::velocity});
  fields.with_default("distance", block.distance,
                      {.unit = "m", .range = core::positive, .help = "in front of the net at the start"});
  fields.with_default(
      "spin", block.spin,
      {.unit = "rad/s", .help = "along the row, up the slope, off it", .plausible = core::plausible::spin});
  fields.optional("along", block.along,
                  {.unit = "m", .help = "where it hits, from the first post; absent: the middle of the row"});
  fields.optional(
      "height", block.height,
      {.unit = "m", .help = "where it hits along the posts, from their feet; absent: the middle of the net"});
}

void describe(core::Fields& fields, GroundSheet& ground) {
  fields.with_default("friction", ground.friction,
                      {.range = core::not_negative,
                       .help = "of net, ropes and block on it",
                       .plausible = core::plausible::friction});
}

void describe(core::Fields& fields, TestSheet& test) {
  fields.choice(
      "start", test.start, {"flat", "hung"},
      "the net as it was laid out, or hanging under its weight (found by relaxation before time 0)");
  fields.choice("breaks", test.breaks, {"nothing", "at_breaking_load"},
                "whether ropes, and rings, are lost at their breaking loads");
  fields.with_default("time", test.time, {.unit = "s", .range = core::positive, .help = "of the run"});
  fields.optional(
      "step", test.step,
      {.unit = "s", .range = core::positive, .help = "absent: 25 us, with friction of the ropes 8 us"});
}

void describe(core::Fields& fields, BarrierSheet& barrier) {
  fields.with_default("slope", barrier.slope,
                      {.unit = "rad",
                       .range = any_angle,
                       .help = "of the ground against the horizontal; 90 deg: the vertical drop test"});
  fields.section("posts", barrier.posts, "hinged at their feet, in a row");
  fields.section("net", barrier.net, "between the support ropes");
  fields.section("support_ropes", barrier.support_ropes, "above and below, through all heads and feet");
  fields.section("retaining_ropes", barrier.retaining_ropes, "from every head up the slope");
  fields.section("lateral_ropes", barrier.lateral_ropes, "from the edge posts' heads to the sides");
  fields.section("block", barrier.block, "that hits it");
  fields.section("ground", barrier.ground,
                 "stops the net, the lower ropes and the block; absent: they pass through it");
  fields.section("test", barrier.test, "how long, and from where");
}

LoadedSheet load_sheet(const std::filesystem::path& path) {
  const auto file = core::SceneFile::load(path);
  core::SceneReader reader(file, {"title", "barrier"});
  LoadedSheet loaded{file.title(), reader.required<BarrierSheet>("barrier")};
  reader.finish();
  return loaded;
}

std::string sheet_schema() {
  return core::schema_markdown("barrier", "a barrier's data sheet", [](core::Fields& fields) {
    BarrierSheet barrier;
    describe(fields, barrier);
  });
}

}  // namespace talus::barrier
