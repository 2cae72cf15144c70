#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/folder.hpp"

/// Programs started by a test, as a user would start them.
namespace talus::test {

struct Ended {
  int code = 0;        ///< exit code; -1 where a signal ended it
  std::string output;  ///< standard output and standard error
};

/// A program in a process group of its own, its output in a file.
class Program {
 public:
  Program(const std::vector<std::string>& command, const std::filesystem::path& output);
  ~Program();  ///< kills what still runs of its group
  Program(const Program&) = delete;

  int pid() const { return pid_; }
  /// Waits for its end. Fails the test after `limit`.
  Ended wait(std::chrono::seconds limit = std::chrono::seconds(30));
  /// Sends a signal to the program alone.
  void signal(int number) const;
  /// Sends it to its whole process group, as a terminal that is closed does.
  void signal_group(int number) const;

 private:
  int pid_ = -1;
  std::filesystem::path output_;
};

/// Process ids of the children of a process, with the name of each one's program.
struct ChildProcess {
  int pid = 0;
  std::string name;
};
std::vector<ChildProcess> children_of(int pid);
bool exists(int pid);
/// Likewise, but one that has ended and that nobody has reaped yet does not count.
bool is_running(int pid);

}  // namespace talus::test
