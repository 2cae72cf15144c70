#pragma once

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

/// Compares the tables and counts of a finished run with the baseline.
Outcome judge(const Regression& regression, const ScheduledRun& run, const FinishedRun& finished);
/// Puts the result of a finished run in the baseline's place; a failed run leaves the baseline as it is.
Outcome update(const Regression& regression, const ScheduledRun& run, const FinishedRun& finished);

}  // namespace talus::coupler::regress
