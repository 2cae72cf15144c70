#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "coupler/run/schedule.hpp"
#include "coupler/session/session.hpp"

namespace talus::core {
class CheckpointReader;
class StateArchive;
}  // namespace talus::core

/// checkpoint.h5: the state of a whole run at the start of a window, in one file that is complete or absent.
/// It holds the coupler's own state and, as they are, the files that the participants write.
namespace talus::coupler {

/// Writes or reads what the coupler's scheme and exchange remember.
using ArchiveOwnState = std::function<void(core::StateArchive&)>;

/// "a, b": the participants that write no checkpoints; empty where all do. None is restarted without the
/// others.
std::string without_checkpoints(Session& session);

/// Writes the checkpoints of a run, each in place of the one before.
class Checkpoints {
 public:
  struct Plan {
    std::filesystem::path folder;
    std::optional<double> every;  ///< s of wall time; absent: only on request
    Span span;
  };
  Checkpoints(Session& session, Plan plan, ArchiveOwnState archive);

  /// At the start of a window, where one is due.
  void at(std::int64_t window);
  /// Now, unless a participant writes none.
  void write(std::int64_t window);

 private:
  using Clock = std::chrono::steady_clock;
  Session& session_;
  Plan plan_;
  ArchiveOwnState archive_;
  bool possible_;
  Clock::time_point last_ = Clock::now();
};

/// A checkpoint that a run goes on from.
class RestartPoint {
 public:
  /// @throws core::ConfigError where the file is no checkpoint of a run, or of windows of another length
  RestartPoint(const std::filesystem::path& file, const Span& span);
  ~RestartPoint();

  std::int64_t window() const { return window_; }
  /// Sets the state of everybody. @param folder for the participants' parts meanwhile
  void restore(Session& session, const std::filesystem::path& folder, const ArchiveOwnState& archive);

 private:
  std::filesystem::path file_;
  Span span_;
  std::unique_ptr<core::CheckpointReader> reader_;
  std::int64_t window_ = 0;
};

}  // namespace talus::coupler
