#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "coupler/study/plan.hpp"

namespace talus::study {

/// How the points are run.
struct RunnerOptions {
  std::filesystem::path program;  ///< talus
  std::filesystem::path folder;   ///< of the runs' folders
  int repeats = 5;
  int threads = 1;
  double time_limit = 600;  ///< s
};

/// How a point ended.
enum class Outcome { ok, failed, unstable, too_slow };
const char* name_of(Outcome outcome);

/// Runs one point, repeatedly, into its own folder, which appears only when it is complete. A point that is
/// complete for the same scene and at least as many repeats is left as it is, so that an interrupted study
/// continues where it stopped.
///
/// Any number of processes, on any number of machines that share the folder, may run points of one study at
/// the same time.
///
/// @return false where a stop was requested meanwhile
bool run_point(const PlannedRun& run, const RunnerOptions& options);

/// What run_point left behind: outcome, message, timings, the summary. Null where the point is not complete.
nlohmann::json read_point(const PlannedRun& run, const std::filesystem::path& folder);

/// Processor, cores, system and load of this machine, for the record.
nlohmann::json machine_record();

/// Keeps this process and all it starts on the first `cores` cores it may use; 0: all of them.
void pin_to_cores(int cores);

}  // namespace talus::study
