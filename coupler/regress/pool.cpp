#include "coupler/regress/pool.hpp"

#include <chrono>
#include <list>
#include <thread>

#include "core/program/stop.hpp"

namespace talus::coupler::regress {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto between_looks = std::chrono::milliseconds(10);

struct Running {
  std::size_t index;
  launch::Child child;
  Clock::time_point since;
};

launch::Child start(const ScheduledRun& run, const std::filesystem::path& program) {
  const std::string script = R"(exec "$0" run "$1" --out "$2" --overwrite --quiet > "$3" 2>&1)";
  return launch::Child(
      {.name = program, .command = {"/bin/sh", "-c", script, program, run.scene, run.folder, run.console}});
}

double seconds_since(Clock::time_point moment) {
  return std::chrono::duration<double>(Clock::now() - moment).count();
}

/// Takes those that have ended out of `running`, and ends those whose time is over.
void collect(std::list<Running>& running, const std::vector<ScheduledRun>& runs,
             std::vector<FinishedRun>& finished) {
  std::erase_if(running, [&](Running& run) {
    const double seconds = seconds_since(run.since);
    if (const auto status = run.child.status()) {
      finished[run.index] = {.status = *status, .seconds = seconds};
      return true;
    }
    if (seconds < runs[run.index].time_limit) return false;
    run.child.end();
    finished[run.index] = {.status = {}, .seconds = seconds, .too_slow = true};
    return true;
  });
}

}  // namespace

std::optional<std::vector<FinishedRun>> run_side_by_side(const std::vector<ScheduledRun>& runs, int jobs,
                                                         const std::filesystem::path& program) {
  std::vector<FinishedRun> finished(runs.size());
  std::list<Running> running;
  for (std::size_t next = 0; next < runs.size() || !running.empty();) {
    if (core::stop_requested()) {
      for (Running& run : running) run.child.ask_to_end();  // all at once; their ends are then waited for
      return std::nullopt;
    }
    while (next < runs.size() && running.size() < static_cast<std::size_t>(jobs)) {
      running.push_back({next, start(runs[next], program), Clock::now()});
      ++next;
    }
    std::this_thread::sleep_for(between_looks);
    collect(running, runs, finished);
  }
  return finished;
}

}  // namespace talus::coupler::regress
