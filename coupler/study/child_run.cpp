#include "coupler/study/child_run.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>

#include "core/program/stop.hpp"
#include "coupler/launch/child.hpp"

namespace talus::study {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double pause = 0.1;  // s; between looks at whether the study is to stop

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

ChildEnd run_child(const std::vector<std::string>& command, const std::filesystem::path& log,
                   double time_limit) {
  using Reason = ChildEnd::Reason;
  const auto started = Clock::now();
  coupler::launch::Child child({.name = command.front(), .command = command}, log);
  while (true) {
    const double left = time_limit - seconds_since(started);
    const auto end = child.wait_end(std::clamp(left, 0.0, pause));
    const double seconds = seconds_since(started);
    if (end && end->signal != 0) return {Reason::killed, end->signal, seconds};
    if (end) return {Reason::exited, end->code, seconds};
    if (core::stop_requested()) return {Reason::stop_requested, 0, seconds};
    if (left <= 0) return {Reason::time_limit, 0, seconds};
  }
}

std::string last_line(const std::filesystem::path& log) {
  std::ifstream lines(log);
  std::string line, last;
  while (std::getline(lines, line))
    if (!line.empty()) last = line;
  return last;
}

}  // namespace talus::study
