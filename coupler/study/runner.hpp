#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "coupler/study/fingerprint.hpp"
#include "coupler/study/load.hpp"
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

/// How a run ended, as a point's record says it.
///
/// What the scene itself decides (refused, unstable) and what the study decides (too slow) stays. What the machine
/// did, such as a kill, a full disk or a lost solver, says nothing of the scene: such a point is tried again when
/// the study is called again.
enum class Ending { good, unstable, refused, too_slow, ended_by_the_machine };
const char* name_of(Ending ending);

/// Runs points, each repetition of its own, and keeps what they leave.
///
/// A point's folder holds its last result and point.json, its record: ending, message, the times of all its
/// repetitions with the load that others put on the machine before each, the summary, the fingerprint. The folder
/// appears when its first run is complete and is replaced when the next one is, so that an interrupted study
/// continues where it stopped. Records of another fingerprint or another machine are not continued.
///
/// Any number of processes, on any number of machines that share the folder, may run different points of one study
/// at the same time.
class Runner {
 public:
  explicit Runner(const RunnerOptions& options);

  /// Runs the point once more, unless it has so many good runs (one of a point that is only there for the
  /// reference, whose time nobody reads) or has failed for good.
  /// @returns false where a stop was requested meanwhile
  bool run_up_to(int repeats, const PlannedRun& run);
  /// Whether run_up_to() would run nothing.
  bool is_complete(int repeats, const PlannedRun& run);
  /// s of wall time that a run may take from here on.
  void give_up_after(double seconds) { options_.time_limit = seconds; }

 private:
  bool is_done(const nlohmann::json& record, int repeats, const PlannedRun& run) const;
  nlohmann::json record_to_continue(const PlannedRun& run);
  bool run_once(nlohmann::json record, const PlannedRun& run);

  RunnerOptions options_;
  Fingerprints fingerprints_;
  OtherLoad load_;
  nlohmann::json machine_;
  std::set<std::string> given_up_;  ///< ended by the machine since this object began
};

/// What a point left behind, whatever its fingerprint; null where it has left nothing.
nlohmann::json read_point(const PlannedRun& run, const std::filesystem::path& folder);

/// The order of the runs: methods in turn at each value, so that what slows the machine for a while slows all of them.
/// Indices into `runs`; a group is the runs at one value.
std::vector<std::vector<std::size_t>> interleaved(const std::vector<PlannedRun>& runs);

/// Processor, cores and system of this machine, for the record.
nlohmann::json machine_record();

/// Keeps this process and all it starts on the first `cores` cores it may use; 0: all of them.
void pin_to_cores(int cores);

}  // namespace talus::study
