#pragma once

#include <filesystem>

#include "core/errors.hpp"

namespace talus::coupler::regress {

struct RegressRequest {
  std::filesystem::path folder;
  std::filesystem::path out = "results/regress";  ///< results, consoles and junit.xml
  bool update = false;
  int jobs = 0;  ///< 0: one for each core
};

/// `talus regress`: runs every regression of a folder and compares it with its baseline, or makes its result
/// the baseline.
/// @returns ExitCode::regression where one differs or fails
/// @throws core::ConfigError
core::ExitCode regress(const RegressRequest& request);

}  // namespace talus::coupler::regress
