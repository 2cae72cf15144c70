#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "coupler/study/plan.hpp"

namespace talus::study {

/// A point with its error and its cost.
struct Point {
  std::string method;
  double error = 0;
  double seconds = 0;  ///< median wall time of the time loop
};

/// For each point, whether no other is both at least as exact and at least as fast (and better in one).
std::vector<bool> pareto_front(const std::vector<Point>& points);

/// The table of a study: every point with its outcome, timings, costs; for each quantity the reference, the
/// floor, errors, the front, and who is fastest to an error or most exact in a time. This is study.json and
/// what the page draws (docs/studies.md describes it).
nlohmann::json analyse(const LoadedStudy& study, const std::vector<PlannedRun>& runs,
                       const std::filesystem::path& runs_folder);

/// The points of analyse() as a table, one row a point.
std::string to_csv(const nlohmann::json& analysis);

}  // namespace talus::study
