#include "coupler/regress/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
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
struct Counted {
  const char* pointer;
  bool always = true;  ///< else only where the run has such a thing, as a strong scheme its windows
};
constexpr std::array counted{Counted{"/status"},
                             Counted{"/rows"},
                             Counted{"/frames"},
                             Counted{"/participants"},
                             Counted{"/iterations/windows", false},
                             Counted{"/iterations/windows_not_converged", false},
                             Counted{"/iterations/windows_halved", false},
                             Counted{"/free_flight/windows", false}};

/// "dem_solver 0.1.0" as "dem_solver": who computed is compared, not which version of it.
std::string without_version(const std::string& program) {
  const auto space = program.rfind(' ');
  const bool versioned = space != std::string::npos && space + 1 < program.size() &&
                         std::isdigit(static_cast<unsigned char>(program[space + 1])) != 0;
  return versioned ? program.substr(0, space) : program;
}

json compared(json value) {
  if (value.is_string()) return without_version(value);
  if (value.is_object())
    for (auto& inner : value) inner = compared(inner);
  return value;
}

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

json summary_in(const fs::path& folder) {
  return json::parse(text_of(folder / "summary.json"));
}

/// Why the run has no result to look at; empty: it has one.
std::string failure_of(const ScheduledRun& run, const FinishedRun& finished) {
  if (finished.too_slow)
    return fmt::format("the run was ended at its time limit of {:g} s (regression.time_limit): {}",
                       run.time_limit, text_of(run.console));
  if (finished.status.code == 0 && finished.status.signal == 0) return {};
  return "the run " + finished.status.text() + ": " + text_of(run.console);
}

bool is_counted(const std::string& pointer) {
  return std::ranges::any_of(counted, [&](const Counted& one) { return pointer == one.pointer; });
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
  const auto other = first_other_count(json::parse(text_of(regression.baseline / counts_file)),
                                       counts_of(summary_in(run.folder)));
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

json counts_of(const json& summary) {
  json counts = json::object();
  for (const auto& [pointer, always] : counted) {
    const json::json_pointer place(pointer);
    if (summary.contains(place))
      counts[pointer] = compared(summary.at(place));
    else if (always)
      throw core::ConfigError(fmt::format("summary.json has no {}", pointer));
  }
  return counts;
}

std::string first_other_count(const json& baseline, const json& found) {
  for (const auto& [pointer, value] : baseline.items()) {
    if (!is_counted(pointer))
      return fmt::format(
          "the baseline has {}, which is not compared; make it anew with talus regress --update", pointer);
    if (!found.contains(pointer)) return fmt::format("{} is gone", pointer);
    if (found[pointer] != compared(value))
      return fmt::format("{} is {}, was {}", pointer, found[pointer].dump(), value.dump());
  }
  for (const auto& [pointer, value] : found.items())
    if (!baseline.contains(pointer)) return fmt::format("{} is new, {}", pointer, value.dump());
  return {};
}

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
  core::replace_file(regression.baseline / counts_file, counts_of(summary_in(run.folder)).dump(1) + "\n");
  outcome.verdict = Verdict::updated;
  return outcome;
}

}  // namespace talus::coupler::regress
