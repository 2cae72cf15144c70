#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupler/transport/process.hpp"

/// Programs started by the coupler.
namespace talus::coupler::launch {

/// What is to be started, and what messages call it.
struct Program {
  std::string name;
  std::vector<std::string> command;           ///< program and arguments
  std::filesystem::path file = {};            ///< of a program that a scene names: what really runs
  std::vector<std::string> environment = {};  ///< "NAME=value", besides ours
  std::filesystem::path folder = {};          ///< it is started in; empty: ours
};

/// How a child ended.
struct ExitStatus {
  int code = 0;    ///< of a normal end
  int signal = 0;  ///< 0: normal end
  /// "ended with exit code 3", "was killed by signal 9 (SIGKILL)"
  std::string text() const;
};

/// A running child, the leader of a process group of its own: signals that the terminal or `timeout` sends to
/// the group of the coupler do not reach it, since the coupler decides when a run ends; and what the child
/// starts itself, such as the ranks of an `mpirun`, ends with it. It reads nothing (a group in the background
/// may not read from the terminal).
class Child {
 public:
  /// @param log takes all its output; empty: its standard output goes to our standard error, which leaves ours
  /// to the results
  /// @throws TransportError if the system cannot start it, FileError where `log` cannot be written
  explicit Child(const Program& program, const std::filesystem::path& log = {});
  ~Child();  ///< end()
  Child(Child&& other) noexcept;
  Child& operator=(Child&&) noexcept = delete;
  Child(const Child&) = delete;

  /// The exit status once it has ended. The system keeps its id, and so its group's, until this object ends.
  std::optional<ExitStatus> status();
  /// Sleeps until it has ended, at most `seconds`.
  std::optional<ExitStatus> wait_end(double seconds);
  /// SIGTERM to the whole group, which a stopped process gets too.
  void ask_to_end() noexcept;
  void kill() noexcept;  ///< SIGKILL to what is left of the group
  /// Asks, waits for some seconds, kills, waits again (a process inside of a broken disk does not even hear
  /// SIGKILL), and reaps.
  void end() noexcept;
  pid_t pid() const noexcept { return pid_; }

 private:
  void signal_group(int signal) const noexcept;

  pid_t pid_ = 0;  ///< 0: moved from, or reaped
  transport::ProcessHandle handle_;
  std::optional<ExitStatus> status_;
};

/// s; between SIGTERM and SIGKILL. An `mpirun` gives its ranks one or two.
inline constexpr double patience = 5;

}  // namespace talus::coupler::launch
