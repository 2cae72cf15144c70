#include "coupler/regress/outcome.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/errors.hpp"
#include "core/output/file.hpp"
#include "coupler/regress/compare.hpp"

namespace talus::coupler::regress {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::array tables{"probes.csv", "energy.csv"};
constexpr const char* counts_file = "counts.json";
/// What of summary.json is a count or a name, and must be equal.
constexpr std::array counted{"status", "windows", "rows", "frames", "nonconverged_windows", "participants"};

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

json counts_of(const fs::path& folder) {
  const json summary = json::parse(text_of(folder / "summary.json"));
  json counts;
  for (const char* key : counted) {
    if (summary.contains(key)) counts[key] = summary[key];
  }
  return counts;
}

/// Why the run has no result to look at; empty: it has one.
std::string failure_of(const ScheduledRun& run, const FinishedRun& finished) {
  if (finished.status.code == 0 && finished.status.signal == 0) return {};
  return "the run " + finished.status.text() + ": " + text_of(run.console);
}

std::string first_other_count(const json& baseline, const json& found) {
  for (const auto& [key, value] : baseline.items()) {
    if (!found.contains(key)) return fmt::format("{} is gone", key);
    if (found[key] != value) return fmt::format("{} is {}, was {}", key, found[key].dump(), value.dump());
  }
  return {};
}

/// Adds a comparison to the outcome: the message of the first table that differs, the worst column of all.
void add(const Comparison& comparison, const char* table, Outcome& outcome) {
  if (comparison.worst > outcome.worst) {
    outcome.worst = comparison.worst;
    outcome.worst_column = comparison.worst_column;
  }
  if (comparison.same() || outcome.verdict == Verdict::different) return;
  outcome.verdict = Verdict::different;
  outcome.message = std::string(table) + ": " +
                    (comparison.mismatch.empty() ? text(*comparison.first) : comparison.mismatch);
}

void compare_with_baseline(const Regression& regression, const ScheduledRun& run, Outcome& outcome) {
  for (const char* table : tables) {
    add(compare(read_table(regression.baseline / table), read_table(run.folder / table),
                regression.tolerances),
        table, outcome);
  }
  const auto other =
      first_other_count(json::parse(text_of(regression.baseline / counts_file)), counts_of(run.folder));
  if (other.empty() || outcome.verdict == Verdict::different) return;
  outcome.verdict = Verdict::different;
  outcome.message = "summary.json: " + other;
}

Outcome begin(const Regression& regression, const ScheduledRun& run, const FinishedRun& finished) {
  Outcome outcome;
  outcome.name = regression.name;
  outcome.message = failure_of(run, finished);
  outcome.seconds = finished.seconds;
  if (!outcome.message.empty()) outcome.verdict = Verdict::failed;
  return outcome;
}

}  // namespace

Outcome judge(const Regression& regression, const ScheduledRun& run, const FinishedRun& finished) {
  Outcome outcome = begin(regression, run, finished);
  if (outcome.bad()) return outcome;
  try {
    compare_with_baseline(regression, run, outcome);
  } catch (const std::exception& error) {
    outcome.verdict = Verdict::failed;
    outcome.message = error.what();
  }
  return outcome;
}

Outcome update(const Regression& regression, const ScheduledRun& run, const FinishedRun& finished) {
  Outcome outcome = begin(regression, run, finished);
  if (outcome.bad()) return outcome;
  fs::create_directories(regression.baseline);
  for (const char* table : tables)
    core::replace_file(regression.baseline / table, text_of(run.folder / table));
  core::replace_file(regression.baseline / counts_file, counts_of(run.folder).dump(1) + "\n");
  outcome.verdict = Verdict::updated;
  return outcome;
}

}  // namespace talus::coupler::regress
