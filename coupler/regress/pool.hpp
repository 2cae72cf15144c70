#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupler/launch/child.hpp"

/// Independent runs of scenes side by side, each a `talus run` of its own with its own folder.
namespace talus::coupler::regress {

struct ScheduledRun {
  std::filesystem::path scene;
  std::filesystem::path folder;   ///< of the result
  std::filesystem::path console;  ///< what the run has to say
  double time_limit = 600;        ///< s of wall time
};

struct FinishedRun {
  launch::ExitStatus status;
  double seconds = 0;     ///< of wall time
  bool too_slow = false;  ///< it was ended at its time limit
};

/// Runs all of them, at most `jobs` at a time, each for as long as its time limit allows. Results are in the order of `runs`.
/// @throws core::TransportError where a run cannot be started
/// @returns nothing where the user asked to stop; the runs in progress are then killed
/// @param program talus
std::optional<std::vector<FinishedRun>> run_side_by_side(const std::vector<ScheduledRun>& runs, int jobs,
                                                         const std::filesystem::path& program);

}  // namespace talus::coupler::regress
