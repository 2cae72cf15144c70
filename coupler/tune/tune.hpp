#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/errors.hpp"

namespace talus::tune {

/// `talus tune SCENE --within GOAL [--within GOAL ...] [--budget MINUTES] [--out DIR]`
struct TuneRequest {
  std::filesystem::path scene;
  std::vector<std::string> within;
  double budget = 10;             ///< minutes of wall time
  std::filesystem::path out;      ///< empty: results/<scene's stem>_tune
  std::filesystem::path program;  ///< talus; empty: this one
  int threads = 1;
};

/// Finds the cheapest settings of a scene that meet its goals and writes <scene>_tuned.yaml, tune.json and
/// index.html.
/// @return regression where nothing meets them or the truth is not known well enough; interrupted where a stop
/// was requested: the runs done so far are kept, and the next call goes on from there
core::ExitCode tune(const TuneRequest& request);

}  // namespace talus::tune
