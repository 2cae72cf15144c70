#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "coupler/study/fingerprint.hpp"
#include "coupler/study/plan.hpp"

namespace talus::study {

/// Where the points of a study lie, and what they depend on now.
struct PointStore {
  std::filesystem::path folder;  ///< of the runs' folders
  Fingerprints& fingerprints;
};

/// The table of a study: every point with its outcome, timings, costs; for each quantity the reference, the
/// errors with their bars, the front, and who is fastest to an error or most exact in a time. This is study.json and
/// what the page draws (docs/studies.md describes it).
///
/// A point that no longer stands for its scene counts as missing; one that another build of the programs computed is
/// shown, marked "stale".
nlohmann::json analyse(const LoadedStudy& study, const std::vector<PlannedRun>& runs,
                       const PointStore& store);

/// The points of analyse() as a table, one row a point.
std::string to_csv(const nlohmann::json& analysis);

}  // namespace talus::study
