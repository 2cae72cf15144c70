#include "coupler/scene/coupling_scene.hpp"

#include <array>

namespace talus::coupler {
namespace {

constexpr core::Range relaxation{.low = 0, .high = 2, .low_included = false};
constexpr core::Range filter_range{.low = 1e-7, .high = 1};
constexpr core::Range at_least_one{.low = 1, .high = 100000};
constexpr const char* initial_help = "relaxation of the first iteration";

void describe_common(core::Fields& fields, ImplicitScene& scheme) {
  fields.choice("predictor", scheme.predictor, {"constant", "linear"},
                "how a window's first iterate follows from its start");
  fields.section("tolerance", scheme.tolerance,
                 "when a window counts as converged, on every field of the interface");
  fields.with_default("iterations", scheme.iterations,
                      {.range = at_least_one, .help = "most iterations of a window"});
  fields.optional("shortest_window", scheme.shortest_window,
                  {.unit = "s",
                   .range = core::positive,
                   .help = "a window that takes more iterations is halved, again and again, down to this; "
                           "absent: it is not"});
  fields.choice("not_converged", scheme.not_converged, {"error", "warning"},
                "what a window is that takes more iterations and is not halved");
  fields.one_of(scheme.acceleration,
                {{"fixed", "constant relaxation"},
                 {"aitken", "relaxation after the last two residuals"},
                 {"iqn_ils", "quasi-Newton from the residuals of this window and those before"}});
}

}  // namespace

void describe(core::Fields&, SerialExplicitScene&) {}
void describe(core::Fields&, ParallelExplicitScene&) {}

void describe(core::Fields& fields, FixedScene& acceleration) {
  fields.with_default("factor", acceleration.factor,
                      {.range = relaxation, .help = "share of the residual that is added"});
}

void describe(core::Fields& fields, AitkenScene& acceleration) {
  fields.with_default("initial", acceleration.initial, {.range = relaxation, .help = initial_help});
}

void describe(core::Fields& fields, IqnIlsScene& acceleration) {
  fields.with_default("initial", acceleration.initial, {.range = relaxation, .help = initial_help});
  fields.with_default("columns", acceleration.columns,
                      {.range = at_least_one, .help = "most residual changes that are kept"});
  fields.with_default("windows", acceleration.windows,
                      {.range = core::not_negative, .help = "windows for which they are kept"});
  fields.with_default(
      "filter", acceleration.filter,
      {.range = filter_range, .help = "a change is skipped whose new part is smaller than this share of it"});
}

void describe(core::Fields& fields, ToleranceScene& tolerance) {
  fields.with_default("relative", tolerance.relative,
                      {.range = core::positive, .help = "change of a field over its size"});
  fields.with_default("displacement", tolerance.displacement,
                      {.unit = "m", .range = core::positive, .help = "change that is always small enough"});
  fields.with_default("velocity", tolerance.velocity,
                      {.unit = "m/s", .range = core::positive, .help = "change that is always small enough"});
  fields.with_default("force", tolerance.force,
                      {.unit = "N", .range = core::positive, .help = "change that is always small enough"});
}

void describe(core::Fields& fields, SerialImplicitScene& scheme) {
  fields.choice(
      "relax", scheme.relax, {"motion", "force", "free_motion"},
      "what is iterated on: the boundary's motion, the contact forces, or the motion less what light "
      "nodes answer to them by themselves, for hard contacts in long windows");
  describe_common(fields, scheme.common);
}

void describe(core::Fields& fields, ParallelImplicitScene& scheme) {
  describe_common(fields, scheme.common);
}

void describe(core::Fields& fields, CouplingScene& coupling) {
  fields.optional(
      "window", coupling.window,
      {.unit = "s", .range = core::positive, .help = "time between two exchanges; absent: time.step"});
  fields.optional("longest_window", coupling.longest_window,
                  {.unit = "s",
                   .range = core::positive,
                   .help = "windows grow up to this while nothing touches, and shrink before something does; "
                           "absent: all have the same length"});
  fields.with_default(
      "timeout", coupling.timeout,
      {.unit = "s", .range = core::positive, .help = "longest time a solver may take for one answer"});
  fields.with_default(
      "join_timeout", coupling.join_timeout,
      {.unit = "s", .range = core::positive, .help = "longest time a solver may take to start and join"});
  fields.optional("checkpoint_every", coupling.checkpoint_every,
                  {.unit = "s",
                   .range = core::positive,
                   .help = "wall time between two writings of checkpoint.h5; absent: only an interrupted run "
                           "leaves one"});
  fields.one_of(coupling.scheme,
                {{"serial_explicit", "particles, then structure, once a window (the default)"},
                 {"parallel_explicit", "both at the same time, once a window"},
                 {"serial_implicit", "one after the other, repeated until both agree"},
                 {"parallel_implicit", "both at the same time, repeated until they agree"}});
}

const char* name_of(const SchemeScene& scheme) {
  static constexpr std::array names{"serial_explicit", "serial_explicit", "parallel_explicit",
                                    "serial_implicit", "parallel_implicit"};
  static_assert(names.size() == std::variant_size_v<SchemeScene>);
  return names[scheme.index()];
}

const ImplicitScene* CouplingScene::implicit() const {
  if (const auto* serial = std::get_if<SerialImplicitScene>(&scheme)) return &serial->common;
  if (const auto* parallel = std::get_if<ParallelImplicitScene>(&scheme)) return &parallel->common;
  return nullptr;
}

Order CouplingScene::order() const {
  const auto* serial = std::get_if<SerialImplicitScene>(&scheme);
  if (serial != nullptr && serial->relax == SerialImplicitScene::Relax::free_motion)
    return Order::iterated_light;
  if (implicit() != nullptr) return Order::iterated;
  return std::holds_alternative<ParallelExplicitScene>(scheme) ? Order::together : Order::in_turn;
}

}  // namespace talus::coupler
