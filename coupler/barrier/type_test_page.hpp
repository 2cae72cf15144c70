#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace talus::barrier {

/// Writes report.json and report.html, one file with everything in it, into the folder of a type test. The page has a
/// replay of every impact that left fields. @param report as run_type_test() returns it
void write_type_test_report(const std::filesystem::path& folder, const nlohmann::json& report);

}  // namespace talus::barrier
