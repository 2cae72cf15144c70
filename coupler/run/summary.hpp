#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "coupler/run/prepared_run.hpp"
#include "coupler/schemes/convergence.hpp"

/// What the coupler adds to summary.json, and what the user reads of it in the end.
namespace talus::coupler {

/// Programs, limits, warnings, what limits the step, and how well the two surfaces of the interface lie on
/// each other.
void add_facts(nlohmann::json& summary, const PreparedRun& run);

/// Iterations a strong scheme took, and a warning where windows did not converge.
void add_iterations(nlohmann::json& summary, const IterationTally& tally);

/// Peaks and their times, energy error, real-time factor, what limited the step, warnings, where the files
/// are; read from the summary in `folder`, so that both say the same.
std::string closing_words(const std::filesystem::path& folder);

}  // namespace talus::coupler
