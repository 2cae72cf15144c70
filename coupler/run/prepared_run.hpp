#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "coupler/run/limits.hpp"
#include "coupler/scene/coupled_scene.hpp"
#include "coupler/session/introduction.hpp"

namespace talus::coupler {

/// A side whose program the scene names, and which was not started because nobody said that it may be.
struct NotAsked {
  Role role;
  std::filesystem::path program;
};

/// A scene whose participants run, have introduced themselves and wait for their first command.
struct PreparedRun {
  core::SceneFile file;
  CoupledScene scene;
  std::unique_ptr<Session> session;
  std::optional<Interface> interface;
  std::vector<CheckedLimit> limits;  ///< tightest first; not judged yet
  std::vector<NotAsked> not_asked{};

  double window_length() const { return scene.window(); }
};

struct PrepareOptions {
  std::filesystem::path scene;
  int threads = 1;              ///< of each of Talus's own solvers
  std::vector<Role> by_hand{};  ///< sides that somebody else starts
  /// Programs that the scene names are started. A scene from elsewhere may name any.
  bool trust = true;
};

/// Reads the scene, starts its solvers and hears them.
/// @throws core::ConfigError with the complaints of all programs about the scene, TransportError, Interrupted
PreparedRun prepare(const PrepareOptions& options);

}  // namespace talus::coupler
