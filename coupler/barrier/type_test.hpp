#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "coupler/barrier/sheet.hpp"

namespace talus::barrier {

/// A type test on the computer (EAD 340059): the barrier comes to rest under its weight; two impacts at a third of the
/// energy, one after the other without repair; one of the whole energy on another, fresh barrier.
struct TypeTest {
  LoadedSheet loaded;
  std::string sheet_file;         ///< its name, for the report
  std::filesystem::path folder;   ///< takes a scene and a result for every stage, and the report
  std::set<std::string> impacts;  ///< of "sel", "mel"
  double time_limit = 0;          ///< s; of every stage
  std::function<void(const std::string&)> tell = [](const std::string&) {};  ///< a line on what goes on
};

/// Runs the stages and measures them. A stage that fails is told in the report, and what needs it is left out.
/// @returns what report.json holds: rules, numbers, layout, what is not covered; nothing where the user has stopped it
/// @throws ConfigError where the barrier does not even come to rest, TransportError and FileError as children do
std::optional<nlohmann::json> run_type_test(const TypeTest& test);

}  // namespace talus::barrier
