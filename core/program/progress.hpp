#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace talus::core {

enum class ProgressStyle {
  automatic,  ///< `line` on a terminal, else `rare`
  line,       ///< one line, redrawn
  rare,       ///< a line at each tenth of the run, at most one a second
  json,       ///< one JSON object a line
  quiet,      ///< nothing
};

/// Where a run is.
struct ProgressState {
  double time = 0;          ///< s, simulated
  double end = 0;           ///< s
  std::int64_t steps = 0;   ///< steps or windows done
  double energy_error = 0;  ///< relative, see LedgerBalance
  std::string limit = {};   ///< what limits the step, e.g. "cable net"; empty: unknown
};

/// Shows how a run gets on: simulated time, steps, real-time factor (simulated time over wall time), energy
/// error, limit of the step, time left.
class Progress {
 public:
  /// @param unit what is counted: "steps" or "windows"
  Progress(ProgressStyle style, std::string unit, std::FILE* stream = stderr);
  /// Cheap enough for every step: looks at the clock only each `1024` steps or where nothing was shown for
  /// long.
  void update(const ProgressState& state);
  /// Why nothing moves: "waits 20 s for structure: computing, 98 % CPU".
  void note(const std::string& text);
  /// The last line, and a line break.
  void finish(const ProgressState& state);

 private:
  using Clock = std::chrono::steady_clock;
  bool is_due(const ProgressState& state) const;
  void show(const ProgressState& state);
  void show_line(std::string line);
  void print(const std::string& text);
  double wall() const;

  ProgressStyle style_;
  std::string unit_;
  std::FILE* stream_;
  Clock::time_point started_ = Clock::now();
  Clock::time_point shown_ = {};
  double next_share_ = 0.1;
  std::size_t width_ = 0;
};

/// One line for people: "0.0512 / 0.2 s  1024 windows  1.3 x real time  energy -2e-05  limited by cable net
/// 2 s left"
std::string progress_line(const ProgressState& state, const std::string& unit, double wall_seconds);
/// The same as a JSON object.
std::string progress_json(const ProgressState& state, const std::string& unit, double wall_seconds);

}  // namespace talus::core
