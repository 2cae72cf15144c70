#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/output/file.hpp"

namespace talus::core {

/// A table of numbers as comma-separated values. Every row is one write, with the fewest digits that give
/// back the same double.
class CsvFile {
 public:
  /// @throws UsageError where a column's name is empty, given twice, or holds a comma, quote or line break.
  CsvFile(const std::filesystem::path& path, const std::vector<std::string>& columns);
  /// @pre values.size() == columns
  void write_row(std::span<const double> values);
  /// No row may follow. @throws FileError where the system says only now that there was no room
  void close() { file_.close(); }

 private:
  OutputFile file_;
  std::string line_;
};

}  // namespace talus::core
