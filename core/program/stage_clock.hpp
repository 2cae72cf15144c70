#pragma once

#include <chrono>
#include <span>
#include <string>
#include <vector>

#include "core/output/source.hpp"

namespace talus::core {

/// Where the time of a run's steps goes: seconds of each stage so far. A scene asks for it by
/// `output.stage_times`; one that does not has no such clock.
class StageClock {
 public:
  /// @param side "structure" or "particles"
  StageClock(std::string side, std::vector<std::string> stages)
      : side_(std::move(side)), stages_(std::move(stages)), seconds_(stages_.size(), 0.0) {}

  /// A step begins.
  void start() noexcept { last_ = Clock::now(); }
  /// The time since start() or the last lap belongs to this stage.
  void lap(std::size_t stage) noexcept {
    const Clock::time_point now = Clock::now();
    seconds_[stage] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

  /// Columns of probes.csv, one a stage: "structure_time.motion_of_nodes_s".
  void describe(std::vector<ProbeDescription>& probes) const {
    for (const auto& stage : stages_) probes.push_back({side_ + "_time." + stage + "_s"});
  }
  std::span<const std::string> stages() const noexcept { return stages_; }
  std::span<const double> seconds() const noexcept { return seconds_; }

 private:
  using Clock = std::chrono::steady_clock;
  std::string side_;
  std::vector<std::string> stages_;
  std::vector<double> seconds_;
  Clock::time_point last_ = Clock::now();
};

/// What a step calls: nothing happens where no clock runs.
inline void start(StageClock* clock) noexcept {
  if (clock != nullptr) clock->start();
}
inline void lap(StageClock* clock, std::size_t stage) noexcept {
  if (clock != nullptr) clock->lap(stage);
}

}  // namespace talus::core
