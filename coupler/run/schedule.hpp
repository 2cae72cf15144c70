#pragma once

#include <cmath>
#include <cstdint>

#include "core/steps.hpp"
#include "coupler/schemes/window.hpp"

namespace talus::coupler {

/// How the span of a run is cut.
struct Span {
  double end = 0;            ///< s
  double window_length = 0;  ///< s
  std::int64_t windows() const { return core::steps_in(end, window_length); }
  /// The regular window number n.
  Window window(std::int64_t n) const { return {.index = n, .unit = window_length}; }
};

/// Events that recur every so many seconds, each at the start of the window nearest to its time. Counted in
/// integers, so that nothing drifts; events closer than a window fall on every window.
class Schedule {
 public:
  Schedule(const Span& span, double every) : every_in_windows_(every / span.window_length) {}

  bool due(std::int64_t window) const { return next_ <= window; }
  /// The window that is due next.
  std::int64_t next() const { return next_; }
  /// Moves on to the first event after `window`.
  void done(std::int64_t window) {
    while (next_ <= window) next_ = std::llround(static_cast<double>(++event_) * every_in_windows_);
  }
  /// Events of a run that takes one at time 0 and one at its end.
  std::int64_t count(std::int64_t windows) const {
    return static_cast<std::int64_t>(static_cast<double>(windows) / every_in_windows_) + 2;
  }

 private:
  double every_in_windows_;
  std::int64_t event_ = 0, next_ = 0;
};

}  // namespace talus::coupler
