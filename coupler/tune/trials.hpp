#pragma once

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "coupler/study/runner.hpp"
#include "coupler/tune/candidate.hpp"

namespace talus::tune {

/// Settings that were run.
struct Trial {
  std::string id, name;

  Candidate candidate;
  bool good = false;
  std::string ending, message;
  nlohmann::json summary;       ///< of a good one
  std::vector<double> seconds;  ///< wall time of the time loop, of each repetition
  /// s; the least of all repetitions: other work on the machine only ever adds to it.
  double least() const { return *std::ranges::min_element(seconds); }
};

/// Why a run was not made.
enum class Refusal { stopped, budget };

/// Runs settings over a scene, each in a folder of its own that is complete or absent (study::Runner), so
/// that another call goes on from what is there. What is there costs nothing.
class Trials {
 public:
  struct Options {
    std::filesystem::path scene, folder, program;
    double budget = 600;  ///< s of wall time for all runs of this call
    int threads = 1;
  };
  explicit Trials(const Options& options);

  /// What the scene itself names: these settings are run as the scene is.
  void set_given(const Candidate& given);

  /// The trial of these settings after so many repetitions.
  /// @param longest s; a run that takes longer is given up, as it cannot win
  /// @returns nothing where the budget is over or a stop was requested, and it is not there
  const Trial* run(const Candidate& candidate, int repeats = 1, double longest = HUGE_VAL);
  /// More settings over it, such as a neighbouring scene's; not kept among all().
  std::optional<Trial> run_beside(const Candidate& candidate, const std::vector<study::Setting>& more);

  const std::map<std::string, Trial>& all() const { return trials_; }
  double seconds_left() const;
  bool stopped() const { return stopped_; }
  bool out_of_budget() const { return out_of_budget_; }
  /// Keeps this share of the budget for what is to come; run() says no beyond.
  void reserve(double share) { reserved_ = share; }
  std::filesystem::path result_of(const Trial& trial) const { return options_.folder / trial.id / "result"; }

 private:
  std::optional<Trial> run_scene(const Candidate& candidate, const std::vector<study::Setting>& more,
                                 int repeats, double longest);

  Options options_;
  Candidate given_{};
  study::Runner runner_;
  std::chrono::steady_clock::time_point started_;
  std::map<std::string, Trial> trials_;
  double reserved_ = 0;
  bool stopped_ = false, out_of_budget_ = false;
};

}  // namespace talus::tune
