#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "coupler/run/prepared_run.hpp"
#include "coupler/schemes/convergence.hpp"
#include "coupler/schemes/free_flight.hpp"

/// What the coupler adds to summary.json, and what the user reads of it in the end.
namespace talus::coupler {

/// Programs, limits, warnings, what limits the step, and how well the two surfaces of the interface lie on
/// each other.
void add_facts(nlohmann::json& summary, const PreparedRun& run);

/// The cost that does not depend on the machine: calls of both solvers, and their evaluations of all forces
/// where they tell. Of a restarted run, those since the restart.
void add_work(nlohmann::json& summary, Session& session);

/// Iterations a strong scheme took, windows it halved, and a warning where windows did not converge.
/// @param window_length s; of a regular window
void add_iterations(nlohmann::json& summary, const IterationTally& tally, double window_length);
/// Windows that grew while nothing touched.
void add_flight(nlohmann::json& summary, const FlightTally& tally, double window_length);

/// Peaks and their times, energy error, real-time factor, what limited the step, warnings, where the files
/// are; read from the summary in `folder`, so that both say the same.
std::string closing_words(const std::filesystem::path& folder);

}  // namespace talus::coupler
