#include "coupler/regress/pool.hpp"

#include <chrono>
#include <list>
#include <thread>

#include "core/program/stop.hpp"
#include "coupler/launch/find_solver.hpp"

namespace talus::coupler::regress {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto between_looks = std::chrono::milliseconds(10);

struct Running {
  std::size_t index;
  launch::Child child;
  Clock::time_point since;
};

launch::Child start(const ScheduledRun& run) {
  const std::string script = R"(exec "$0" run "$1" --out "$2" --overwrite --quiet > "$3" 2>&1)";
  return launch::Child(
      {"/bin/sh", "-c", script, launch::program_folder() / "talus", run.scene, run.folder, run.console});
}

/// Takes those that have ended out of `running`.
void collect(std::list<Running>& running, std::vector<FinishedRun>& finished) {
  std::erase_if(running, [&](Running& run) {
    const auto status = run.child.status();
    if (!status) return false;
    finished[run.index] = {*status, std::chrono::duration<double>(Clock::now() - run.since).count()};
    return true;
  });
}

}  // namespace

std::optional<std::vector<FinishedRun>> run_side_by_side(const std::vector<ScheduledRun>& runs, int jobs) {
  std::vector<FinishedRun> finished(runs.size());
  std::list<Running> running;
  for (std::size_t next = 0; next < runs.size() || !running.empty();) {
    if (core::stop_requested()) {
      for (Running& run : running) run.child.ask_to_end();  // all at once; their ends are then waited for
      return std::nullopt;
    }
    while (next < runs.size() && running.size() < static_cast<std::size_t>(jobs)) {
      running.push_back({next, start(runs[next]), Clock::now()});
      ++next;
    }
    std::this_thread::sleep_for(between_looks);
    collect(running, finished);
  }
  return finished;
}

}  // namespace talus::coupler::regress
