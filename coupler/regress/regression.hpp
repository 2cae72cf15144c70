#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/fields.hpp"

/// A regression is a scene with a section `regression`: usually a few lines that extend an example and end it
/// early. Its result is compared with the baseline that is stored beside it.
namespace talus::coupler::regress {

/// Another tolerance for some columns.
struct ColumnScene {
  std::string contains;
  double relative = 0;
};
void describe(core::Fields& fields, ColumnScene& column);

/// `regression:` how far a value may be from its baseline.
struct RegressionScene {
  double relative = 1e-6;   ///< of the largest magnitude of the column, or of the vector it is a component of
  double absolute = 1e-12;  ///< added to that, in the column's SI unit
  std::vector<ColumnScene> columns;
  double time_limit = 600;  ///< s of wall time; a run that takes longer is ended and counts as failed
};
void describe(core::Fields& fields, RegressionScene& regression);

struct Regression {
  std::string name;                ///< the scene file's stem
  std::filesystem::path scene;     ///< configs/regression/<name>.yaml
  std::filesystem::path baseline;  ///< configs/regression/baselines/<name>/
  RegressionScene tolerances;
};

/// The regressions in `folder`, by name.
/// @throws core::ConfigError where it has none, or with the complaints about their sections
std::vector<Regression> find_regressions(const std::filesystem::path& folder);

}  // namespace talus::coupler::regress
