#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace talus::study {

/// How a program that was run to its end ended.
struct ChildEnd {
  enum class Reason { exited, killed, time_limit, stop_requested };
  Reason reason = Reason::exited;
  int code = 0;        ///< exit code, or the signal
  double seconds = 0;  ///< wall time
};

/// Runs a program with all its output going to `log`, and waits for it, at most `time_limit` seconds.
ChildEnd run_child(const std::vector<std::string>& command, const std::filesystem::path& log,
                   double time_limit);

/// The last line of a program's log that is not empty: what it said at its end.
std::string last_line(const std::filesystem::path& log);

}  // namespace talus::study
