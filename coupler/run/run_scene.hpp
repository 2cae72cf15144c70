#pragma once

#include <filesystem>
#include <vector>

#include "core/errors.hpp"
#include "core/program/command_line.hpp"
#include "coupler/participant.hpp"

namespace talus::coupler {

struct RunRequest {
  std::filesystem::path scene;
  std::filesystem::path restart;  ///< a checkpoint to go on from; empty: from time 0
  std::vector<Role> by_hand;      ///< sides that somebody else starts
  core::RunOptions options;
};

/// `talus run`: from the scene to the written result.
/// @throws core::ConfigError, TransportError, NumericalError; the result, where there is one already, then
/// says that it failed
core::ExitCode run_scene(const RunRequest& request);

}  // namespace talus::coupler
