#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace talus::report {

/// What the page of a result shows: its summary, the curves of its tables, and a replay of its fields (replay.hpp).
/// Works on the result of a run that is still going on or was killed. Curves are thinned to some hundred points,
/// every extreme among them.
/// @throws ConfigError where the folder holds no result
nlohmann::json report_data(const std::filesystem::path& result);

/// The scripts that draw a replay (replay.hpp) and sizes with their units, as elements of a page; they stand before
/// whatever calls them.
std::string replay_scripts();

/// Writes report.html into the result folder, one file with everything in it, and returns its path.
std::filesystem::path write_report(const std::filesystem::path& result);

}  // namespace talus::report
