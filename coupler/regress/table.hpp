#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace talus::coupler::regress {

/// A CSV file of numbers, such as probes.csv and energy.csv.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< as many values a row as there are columns
};

/// @throws core::ConfigError naming file and line where it is missing or no such table
Table read_table(const std::filesystem::path& path);

}  // namespace talus::coupler::regress
