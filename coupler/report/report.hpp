#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace talus::report {

/// What the page of a result shows: its summary, the curves of its tables, and five instants of its fields with that
/// of the largest displacement. Works on the result of a run that is still going on or was killed. Curves are thinned
/// to some hundred points, every extreme among them, and drawings to some ten thousand cells.
/// @throws ConfigError where the folder holds no result
nlohmann::json report_data(const std::filesystem::path& result);

/// Writes report.html into the result folder, one file with everything in it, and returns its path.
std::filesystem::path write_report(const std::filesystem::path& result);

}  // namespace talus::report
