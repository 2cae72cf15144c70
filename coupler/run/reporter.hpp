#pragma once

#include "core/output/result_writer.hpp"
#include "core/program/progress.hpp"
#include "coupler/run/schedule.hpp"
#include "coupler/session/session.hpp"

namespace talus::coupler {

/// Writes what is due at the start of a window, and shows how the run gets on.
class Reporter {
 public:
  struct Plan {
    Span span;
    Schedule rows;
    std::optional<Schedule> frames{};
    std::string limited_by{};  ///< for the progress line
  };
  Reporter(Session& session, core::ResultWriter& results, Plan plan, core::ProgressStyle style);
  ~Reporter();
  Reporter(const Reporter&) = delete;

  /// A run that begins with this window has passed the times before it.
  void begin_at(std::int64_t window);
  /// The state at the start of window `n`, where it is due.
  void at(std::int64_t window);
  /// The window at whose start something is written next; none is due at the one given to at() last.
  std::int64_t next_due() const;
  /// The state the run ends with.
  void last(std::int64_t window);

 private:
  void write(std::int64_t window, bool frame);
  core::ProgressState state(std::int64_t window) const;

  Session& session_;
  core::ResultWriter& results_;
  Plan plan_;
  core::Progress progress_;
  std::int64_t written_ = -1;  ///< the last window written
};

}  // namespace talus::coupler
