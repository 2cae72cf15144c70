#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/output/table.hpp"

namespace talus::explain {

/// What the frames of fields.h5 say of a part of the structure.
struct PartFacts {
  std::string name;
  enum class Kind { line, sheet } kind = Kind::line;
  double tension = 0;          ///< largest; N of a line, Pa of a sheet
  double compression = 0;      ///< largest, positive; likewise
  bool ever_wrinkled = false;  ///< a sheet: anywhere wrinkled or slack in any frame
};

/// A result as the rules look at it.
struct ResultFacts {
  nlohmann::json summary;
  core::Table energy;            ///< energy.csv
  std::vector<PartFacts> parts;  ///< empty where no frames were written

  /// J; the largest kinetic energy of a row, of both sides together.
  double impact() const;
  /// J; the largest magnitude of a ledger line. 0 where there is no such line.
  double largest(const std::string& line) const;
  /// Whether the side named this effect as in; false where it does not know it.
  bool has(const std::string& side, const std::string& effect) const;
  /// Lines of the ledger that begin so.
  std::vector<std::string> lines(const std::string& beginning) const;
};

/// @throws ConfigError where the folder holds no result
ResultFacts read_facts(const std::filesystem::path& result);

}  // namespace talus::explain
