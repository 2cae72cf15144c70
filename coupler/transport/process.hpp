#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

/// Other processes, named so that a reused process id is never mistaken for the process meant.
namespace talus::coupler::transport {

/// A process by id and start time (clock ticks since boot, from /proc; 0 where that is unknown).
struct ProcessIdentity {
  pid_t pid = 0;
  std::uint64_t start = 0;
  bool operator==(const ProcessIdentity&) const = default;
};
ProcessIdentity this_process();
/// Start 0 where the process does not exist or /proc cannot be read.
ProcessIdentity identify(pid_t pid);

/// The kernel's handle of one process (pidfd). It keeps meaning the same process after its end. Where the
/// kernel gives none (no descriptor is left, a sandbox forbids it) the process is asked for by id and start
/// time: not to get a handle is no sign of death.
class ProcessHandle {
 public:
  ProcessHandle() = default;  ///< of no process: alive() is true for ever
  /// A process that is gone already, or whose start time differs, counts as ended.
  explicit ProcessHandle(const ProcessIdentity& identity);
  ~ProcessHandle();
  ProcessHandle(ProcessHandle&& other) noexcept;
  ProcessHandle& operator=(ProcessHandle&& other) noexcept;

  bool alive() const noexcept;
  /// Sleeps until the process ends, at most `milliseconds` (< 0: without limit); true if it ended.
  bool wait_end(int milliseconds) const noexcept;
  void send_signal(int signal) const noexcept;
  pid_t pid() const noexcept { return identity_.pid; }

 private:
  bool there_by_id() const noexcept;
  bool wait_end_by_id(int milliseconds) const noexcept;

  ProcessIdentity identity_;
  int descriptor_ = -1;
  bool gone_ = false;
};

/// What a process does, as /proc says it.
struct ProcessActivity {
  enum class State { runs, sleeps, waits_for_disk, stopped, gone };
  State state = State::gone;
  double cpu_time = 0;  ///< s; that all its threads have used so far
};
/// Nothing where /proc cannot be read.
std::optional<ProcessActivity> activity_of(pid_t pid);

}  // namespace talus::coupler::transport
