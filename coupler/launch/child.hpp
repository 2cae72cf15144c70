#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupler/transport/process.hpp"

/// Programs started by the coupler.
namespace talus::coupler::launch {

/// What is to be started, and what messages call it.
struct Program {
  std::string name;
  std::vector<std::string> command;  ///< program and arguments
};

/// How a child ended.
struct ExitStatus {
  int code = 0;    ///< of a normal end
  int signal = 0;  ///< 0: normal end
  /// "ended with exit code 3", "was killed by signal 9 (SIGKILL)"
  std::string text() const;
};

/// A running child. It ignores Ctrl-C, which the terminal sends to the whole group: the coupler decides when
/// a run ends.
class Child {
 public:
  /// Starts `command` (program and arguments); its standard output goes to our standard error, which leaves
  /// ours to the results.
  /// @throws TransportError if the system cannot start it
  explicit Child(const std::vector<std::string>& command);
  ~Child();  ///< kills and reaps it where it still runs
  Child(Child&&) noexcept = default;
  Child& operator=(Child&&) noexcept = delete;
  Child(const Child&) = delete;

  /// The exit status once it has ended; reaps it.
  std::optional<ExitStatus> status();
  /// Sleeps until it has ended, at most `seconds`.
  std::optional<ExitStatus> wait_end(double seconds);
  void kill();  ///< SIGKILL, and reaps
  pid_t pid() const noexcept { return handle_.pid(); }

 private:
  transport::ProcessHandle handle_;
  std::optional<ExitStatus> status_;
};

}  // namespace talus::coupler::launch
