#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "coupler/transport/process.hpp"

namespace talus::coupler {

/// What a process has done since somebody began to wait for it: computing and stuck look the same from
/// outside, but not in the time it used. Costs nothing in the first quarter of a second of a wait.
class Patience {
 public:
  /// Called each slice of a wait with the seconds waited so far; fewer than at the last call begin a new one.
  /// @param pid <= 0: a thread of this process, of which nothing is said
  void look(pid_t pid, double seconds);
  /// True now and then, first after 10 s, then after 20, 40, 80, ...: time to say who is waited for.
  bool time_to_tell();
  /// "computing, 98 % CPU", "stuck: sleeps, 0 % CPU", "is stopped"; empty where nothing is known.
  std::string condition() const;

 private:
  static constexpr double first_told = 10;  ///< s
  struct Sample {
    double seconds = 0, cpu_time = 0;
  };
  pid_t pid_ = 0;
  double seconds_ = 0, next_told_ = first_told;
  std::optional<Sample> begin_;
};

}  // namespace talus::coupler
