#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

/// Other processes, named so that a reused process id is never mistaken for the process meant.
namespace talus::coupler::transport {

/// A process by id and start time (clock ticks since boot, from /proc).
struct ProcessIdentity {
  pid_t pid = 0;
  std::uint64_t start = 0;
  bool operator==(const ProcessIdentity&) const = default;
};
ProcessIdentity this_process();
/// Start 0 where the process does not exist.
ProcessIdentity identify(pid_t pid);

/// The kernel's handle of one process (pidfd). It keeps meaning the same process after its end.
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
  /// Readable for poll(2) once the process has ended; -1 for no process.
  int descriptor() const noexcept { return descriptor_; }

 private:
  ProcessIdentity identity_;
  int descriptor_ = -1;
  bool gone_ = false;
};

/// "runs", "is stopped", "sleeps", "is gone": for messages about a process that does not answer.
std::string process_condition(pid_t pid);

}  // namespace talus::coupler::transport
