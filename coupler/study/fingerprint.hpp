#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "coupler/study/plan.hpp"

namespace talus::core {
class SceneFile;
}

namespace talus::study {

/// What the result of a point depends on, so that a point that no longer stands for its scene is known as stale.
///
///     {"scene": digest, "files": {path from the runs' folder: digest}, "programs": digest, "threads": 1}
///
/// - scene: its effective content, after everything it extends
/// - files: the content of those the scene names (SceneFile::named_files), its own solvers included. Files that
///   these name in turn are not looked at.
/// - programs: the content of talus, fem_solver and dem_solver
class Fingerprints {
 public:
  /// @param program talus; the solvers stand beside it
  /// @param folder of the runs' folders
  Fingerprints(const std::filesystem::path& program, std::filesystem::path folder, int threads);

  /// @throws ConfigError where the scene cannot be read
  nlohmann::json of(const PlannedRun& run);

 private:
  const std::string& digest_of(const std::filesystem::path& file);
  nlohmann::json files_of(const core::SceneFile& scene);

  std::filesystem::path folder_;
  int threads_;
  std::map<std::filesystem::path, std::string> digests_;  ///< of files that were read already
  std::string programs_;
};

/// What changed between two fingerprints, the gravest first: "its scene changed", "net.msh changed", "the programs
/// were built anew", "the number of threads changed"; empty where they are equal.
std::string difference(const nlohmann::json& before, const nlohmann::json& now);

/// Whether a point with such a difference still stands for its scene, though another program computed it.
bool is_same_scene(const nlohmann::json& before, const nlohmann::json& now);

}  // namespace talus::study
