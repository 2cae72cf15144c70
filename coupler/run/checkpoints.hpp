#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "coupler/run/scene_difference.hpp"
#include "coupler/run/schedule.hpp"
#include "coupler/session/session.hpp"

namespace talus::core {
class CheckpointReader;
class StateArchive;
}  // namespace talus::core

/// checkpoint.h5: the state of a whole run at the start of a window, in one file that is complete or absent.
/// It holds the coupler's own state and, as they are, the files that the participants write. The one before it
/// is kept as checkpoint_before.h5.
namespace talus::coupler {

/// Writes or reads what the coupler's scheme and exchange remember.
using ArchiveOwnState = std::function<void(core::StateArchive&)>;

/// "a, b": the participants that write no checkpoints; empty where all do. None is restarted without the
/// others.
std::string without_checkpoints(Session& session);

/// What a state belongs to.
struct RunIdentity {
  std::string scene_hash;
  std::string scheme;    ///< "serial_explicit"
  FlatScene programs{};  ///< "talus" -> "talus 0.1.0", "structure" -> "fem_solver 0.1.0"
  FlatScene scene{};
};

/// Writes the checkpoints of a run, each in place of the one before.
class Checkpoints {
 public:
  struct Plan {
    std::filesystem::path folder;
    std::optional<double> every;  ///< s of wall time; absent: only on request
    Span span;
    std::function<RunIdentity()> identity{};  ///< asked at the first checkpoint
  };
  Checkpoints(Session& session, Plan plan, ArchiveOwnState archive);

  /// At the start of a window, where one is due. That it cannot be written is a warning: the run goes on, and
  /// the last one stays.
  void at(std::int64_t window);
  /// Now, unless a participant writes none. @throws core::FileError where it cannot be written
  void write(std::int64_t window);

 private:
  using Clock = std::chrono::steady_clock;
  Session& session_;
  Plan plan_;
  ArchiveOwnState archive_;
  bool possible_;
  bool failing_ = false;  ///< the last one could not be written, which was said
  std::optional<RunIdentity> identity_;
  Clock::time_point last_ = Clock::now();
};

/// A checkpoint that a run goes on from.
class RestartPoint {
 public:
  /// @throws core::ConfigError where the file is no checkpoint of a run, of windows of another length, or of a
  /// time after the run's end
  RestartPoint(const std::filesystem::path& file, const Span& span);
  ~RestartPoint();

  std::int64_t window() const { return window_; }
  /// Warns of what has changed since the checkpoint was written.
  /// @throws core::ConfigError where the scene says another state at time 0, which would have no effect
  void compare(const RunIdentity& now);
  /// Sets the state of everybody. @param folder for the participants' parts meanwhile
  void restore(Session& session, const std::filesystem::path& folder, const ArchiveOwnState& archive);

 private:
  std::filesystem::path file_;
  Span span_;
  std::unique_ptr<core::CheckpointReader> reader_;
  std::int64_t window_ = 0;
};

}  // namespace talus::coupler
