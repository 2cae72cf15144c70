#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/output/source.hpp"

namespace talus::core {

/// The tables of a result besides its rows of probes: events in files of their own, distributions in the
/// summary.
class ResultTables {
 public:
  /// Makes <name>.csv for each table of events. The sources must outlive this.
  /// @throws UsageError where two tables, or a table and a file of every result, have the same name
  ResultTables(std::filesystem::path folder, const std::vector<const OutputSource*>& sources);
  ~ResultTables();

  /// Asks the sources: appends the events that are new, and replaces the distributions.
  /// @throws NumericalError where a value is not finite
  void update(double time);
  /// No update may follow. @throws FileError where the system says only now that there was no room
  void close();

  /// Of each table by name: its file and number of rows, or its rows as objects of columns.
  nlohmann::json summary() const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace talus::core
