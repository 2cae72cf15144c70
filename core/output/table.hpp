#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace talus::core {

/// A table of numbers read back from a CSV file of a result; a last row that a kill cut short is left out.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  ///< one a name, all of the same length

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  /// Null where there is no such column.
  const std::vector<double>* column(const std::string& name) const;
};

/// @throws ConfigError where the file is missing or holds anything but numbers
Table read_table(const std::filesystem::path& path);

}  // namespace talus::core
