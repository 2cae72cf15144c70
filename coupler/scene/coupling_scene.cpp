#include "coupler/scene/coupling_scene.hpp"

namespace talus::coupler {

void describe(core::Fields&, SerialExplicitScene&) {}

void describe(core::Fields& fields, CouplingScene& coupling) {
  fields.optional(
      "window", coupling.window,
      {.unit = "s", .range = core::positive, .help = "time between two exchanges; absent: time.step"});
  fields.with_default(
      "timeout", coupling.timeout,
      {.unit = "s", .range = core::positive, .help = "longest time a solver may take for one answer"});
  fields.with_default(
      "join_timeout", coupling.join_timeout,
      {.unit = "s", .range = core::positive, .help = "longest time a solver may take to start and join"});
  fields.one_of(coupling.scheme,
                {{"serial_explicit", "particles, then structure, once a window (the default)"}});
}

}  // namespace talus::coupler
