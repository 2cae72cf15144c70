#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/output/energy_guard.hpp"
#include "core/scene/fields.hpp"

/// The sections every program reads: `title`, `time`, `output`. Those of one side stand in that side's scene/
/// folder.
namespace talus::core {

/// `time:` the span of the run. A solver's own section may name another step.
struct TimeScene {
  double end = 0;  ///< s
  std::optional<double>
      step;  ///< s; the step of both sides, and the coupling window where `coupling.window` is absent
};
void describe(Fields& fields, TimeScene& time);

/// `structure.solver`, `particles.solver`: the program that computes this side, and how it is started. `solver: NAME`
/// is short for `solver: {program: NAME}` (reader.hpp).
struct SolverScene {
  std::optional<std::string> program;           ///< absent: Talus's own
  std::vector<std::string> arguments;           ///< before the scene
  std::vector<std::string> environment;         ///< "NAME=value"
  std::optional<std::string> working_folder;    ///< seen from the file it is written in
  std::vector<std::string> launcher;            ///< a program on PATH and its arguments, before the program
  std::optional<double> timeout, join_timeout;  ///< s; absent: those of `coupling`

  /// Something is started that Talus does not bring, or not as it would start it.
  bool is_foreign() const {
    return program || !arguments.empty() || !environment.empty() || !launcher.empty();
  }
};
void describe(Fields& fields, SolverScene& solver);

/// One named probe: the point of a structure part, or a rock, whose history goes to probes.csv.
struct ProbeScene {
  std::optional<Vector3>
      at;  ///< m; the nearest node of the structure at the reference state, an element's length away at most
  std::optional<std::string> part;  ///< look only among this part's nodes; or, without `at`, the part as a
                                    ///< whole (rope force, brake travel)
  std::optional<std::string> rock;  ///< the name of a rock or sphere
  std::vector<std::string> quantities;  ///< empty: all that fit
};
void describe(Fields& fields, ProbeScene& probe);

/// `output.stage_times: {}`: where the time of the steps goes, as columns of probes.csv.
struct StageTimesScene {};
void describe(Fields& fields, StageTimesScene& stage_times);

/// `output.final_state: {}`: the structure's state at the end, for a run that goes on from there.
struct FinalStateScene {};
void describe(Fields& fields, FinalStateScene& state);

/// `output.largest_forces: {}`: of parts and supports over all steps, in the summary.
struct LargestForcesScene {};
void describe(Fields& fields, LargestForcesScene& forces);

void describe(Fields& fields, EnergyErrorScene& energy_error);

/// `output:` what is written and how often.
struct OutputScene {
  double every = 0;  ///< s between rows of probes.csv and energy.csv; 0: 200 rows over the run
  std::optional<double> fields_every;  ///< s between frames of fields.h5; absent: no field output
  std::vector<std::pair<std::string, ProbeScene>> probes;
  std::optional<StageTimesScene> stage_times;
  std::optional<LargestForcesScene> largest_forces;
  std::optional<FinalStateScene> final_state;
  std::optional<EnergyErrorScene> energy_error_scene;
  EnergyErrorScene energy_error() const { return energy_error_scene.value_or(EnergyErrorScene{}); }
};
void describe(Fields& fields, OutputScene& output);

}  // namespace talus::core
