#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "coupler/regress/pool.hpp"
#include "coupler/regress/regression.hpp"

namespace talus::coupler::regress {

enum class Verdict { same, different, failed, updated };

/// What became of one regression.
struct Outcome {
  std::string name;
  Verdict verdict = Verdict::same;
  std::string message;  ///< the first differing time and field, or why the run failed
  std::string worst_column;
  double worst = 0;    ///< of the distances to the baseline, over the allowed one
  double seconds = 0;  ///< of wall time

  bool bad() const { return verdict == Verdict::different || verdict == Verdict::failed; }
};

/// What of a summary is compared as it is, by its place: {"/rows": 21, ...}. Versions of programs are left out.
/// @throws core::ConfigError where the summary lacks what every summary has
nlohmann::json counts_of(const nlohmann::json& summary);
/// The first difference of two such, in words; a place that is not compared is one. Empty where there is none.
std::string first_other_count(const nlohmann::json& baseline, const nlohmann::json& found);

/// Compares the tables and counts of a finished run with the baseline.
Outcome judge(const Regression& regression, const ScheduledRun& run, const FinishedRun& finished);
/// Puts the result of a finished run in the baseline's place; a failed run leaves the baseline as it is.
Outcome update(const Regression& regression, const ScheduledRun& run, const FinishedRun& finished);

}  // namespace talus::coupler::regress
