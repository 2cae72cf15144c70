#include "core/scene/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/scene/plausible.hpp"

namespace talus::core {

void describe(Fields& fields, TimeScene& time) {
  fields.required("end", time.end,
                  {.unit = "s",
                   .range = positive,
                   .help = "simulated time of the run",
                   .plausible = plausible::duration});
  fields.optional("step", time.step,
                  {.unit = "s",
                   .range = positive,
                   .help = "step of both sides, and the coupling window where that is not given"});
  fields.rule(!time.step || *time.step <= time.end, "step",
              fmt::format("must not be longer than the run, which ends at {} s", time.end));
}

namespace {

bool is_assignment(const std::string& text) {
  const auto end = text.find('=');
  return end != std::string::npos && end > 0 && std::isdigit(static_cast<unsigned char>(text.front())) == 0 &&
         std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

}  // namespace

void describe(Fields& fields, SolverScene& solver) {
  fields.optional(
      "program", solver.program,
      {.help = "looked for relative to the scene, beside talus, then on PATH; a file that ends in .py is "
               "run by Python; absent: Talus's own. `solver: NAME` is short for this key alone"});
  fields.with_default("arguments", solver.arguments,
                      {.help = "what the program is given before the scene, e.g. [--mesh, fine.msh]"});
  fields.with_default(
      "environment", solver.environment,
      {.help = "variables the program gets besides those of talus, e.g. [OMP_NUM_THREADS=4]"});
  fields.optional(
      "working_folder", solver.working_folder,
      {.help = "folder it is started in, seen from the file this stands in; absent: that of talus"});
  fields.with_default(
      "launcher", solver.launcher,
      {.help = "what starts the program, a program on PATH with its arguments, e.g. [mpirun, -n, 4]"});
  fields.optional("timeout", solver.timeout,
                  {.unit = "s",
                   .range = positive,
                   .help = "longest time this side may take for one answer; absent: `coupling.timeout`"});
  fields.optional(
      "join_timeout", solver.join_timeout,
      {.unit = "s",
       .range = positive,
       .help = "longest time this side may take to start and join; absent: `coupling.join_timeout`"});
  const auto wrong = std::find_if_not(solver.environment.begin(), solver.environment.end(), is_assignment);
  fields.rule(wrong == solver.environment.end(), "environment",
              fmt::format("expects NAME=value, got '{}'", wrong == solver.environment.end() ? "" : *wrong));
}

void describe(Fields& fields, ProbeScene& probe) {
  fields.optional("at", probe.at,
                  {.unit = "m",
                   .help = "a point; the nearest node of the structure at the reference state is watched, "
                           "which may be an element's length away"});
  fields.optional("part", probe.part,
                  {.help = "look only among this part's nodes; without `at`, the part as a whole"});
  fields.optional("rock", probe.rock, {.help = "the name of a rock or sphere"});
  fields.with_default("quantities", probe.quantities,
                      {.help = "what to write, e.g. [displacement_z]; all that fit where absent"});
  fields.rule(probe.at || probe.part || probe.rock, "at",
              "needs `at`, `part` or `rock`: what is to be watched?");
  fields.rule(!probe.rock || (!probe.at && !probe.part), "rock",
              "contradicts `at` and `part`, which watch the structure");
}

void describe(Fields&, StageTimesScene&) {}

void describe(Fields&, LargestForcesScene&) {}
void describe(Fields&, FinalStateScene&) {}

void describe(Fields& fields, EnergyErrorScene& energy_error) {
  fields.with_default(
      "warning", energy_error.warning,
      {.range = positive, .help = "share of the run's impact from which on a warning is given"});
  fields.with_default("error", energy_error.error,
                      {.range = positive, .help = "share from which on the run ends as failed"});
  fields.rule(energy_error.warning <= energy_error.error, "warning", "must not be above `error`");
}

void describe(Fields& fields, OutputScene& output) {
  fields.with_default("every", output.every,
                      {.unit = "s",
                       .range = not_negative,
                       .help = "time between rows of probes.csv and energy.csv; 0: 200 rows over the run"});
  fields.optional("fields_every", output.fields_every,
                  {.unit = "s",
                   .range = positive,
                   .help = "time between frames of fields.h5; no fields are written where absent"});
  fields.map("probes", output.probes, "points, parts and rocks whose history is written, by name");
  fields.section("stage_times", output.stage_times,
                 "columns of probes.csv with the seconds that each stage of the steps has taken so far; "
                 "`talus explain` of the result then shows its share");
  fields.section(
      "largest_forces", output.largest_forces,
      "tables of the summary: the largest force of every part and support of the structure over all steps, "
      "and what broke first");
  fields.section(
      "final_state", output.final_state,
      "structure_state.h5, where the structure is at the end, for `structure.start.after` of another scene");
  fields.section("energy_error", output.energy_error_scene,
                 "how far the energy balance may be off, as shares of the energy that the run is about");
}

}  // namespace talus::core
