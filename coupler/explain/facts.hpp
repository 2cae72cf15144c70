#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/output/table.hpp"

namespace talus::explain {

/// What the frames of fields.h5 say of a part of the structure.
struct PartFacts {
  std::string name;
  enum class Kind { line, sheet } kind = Kind::line;
  double tension = 0;       ///< largest; N of a line, Pa of a sheet
  double compression = 0;   ///< largest, positive; likewise
  std::int64_t frames = 0;  ///< that were looked at
  std::optional<bool> gave_way =
      {};  ///< anywhere wrinkled or slack in any frame; nothing where no frame tells
};

/// An effect as its participant declared it (coupler/participant.hpp).
struct EffectFacts {
  std::string side, name, key, ledger_line, limit;
  bool present = false, may_hold = false;
};

/// A result as the rules look at it.
struct ResultFacts {
  nlohmann::json summary;
  core::Table energy;                ///< energy.csv
  std::vector<PartFacts> parts;      ///< empty where no frames were written
  std::vector<EffectFacts> effects;  ///< of all sides

  /// J; the energy that the run is about, as its ledger says (core/output/ledger.hpp). 0: nothing moved, or nobody tells.
  double impact() const;
  /// J; the largest magnitude of a ledger line. Nothing where there is no such line: then it is unknown, not zero.
  std::optional<double> largest(const std::string& line) const;
  /// The effect that takes this limit away; null where nobody declared one.
  const EffectFacts* against(const std::string& limit) const;
};

/// The effects of a summary.
std::vector<EffectFacts> effects_of(const nlohmann::json& summary);

/// @throws ConfigError where the folder holds no result
ResultFacts read_facts(const std::filesystem::path& result);

}  // namespace talus::explain
