#include "coupler/regress/regress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "core/program/stop.hpp"
#include "coupler/launch/find_solver.hpp"
#include "coupler/regress/outcome.hpp"
#include "coupler/regress/report.hpp"

namespace talus::coupler::regress {
namespace {

std::vector<ScheduledRun> schedule(const std::vector<Regression>& regressions,
                                   const std::filesystem::path& out) {
  std::filesystem::create_directories(out);
  std::vector<ScheduledRun> runs;
  for (const auto& regression : regressions) {
    runs.push_back({.scene = regression.scene,
                    .folder = out / regression.name,
                    .console = out / (regression.name + ".console.txt"),
                    .time_limit = regression.tolerances.time_limit});
  }
  return runs;
}

int cores() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace

core::ExitCode regress(const RegressRequest& request) {
  core::watch_stop_signals("with the runs in progress");
  const auto regressions = find_regressions(request.folder);
  const auto runs = schedule(regressions, request.out);
  const auto finished =
      run_side_by_side(runs, request.jobs > 0 ? request.jobs : cores(), launch::program_folder() / "talus");
  if (!finished) return core::ExitCode::interrupted;
  std::vector<Outcome> outcomes;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    outcomes.push_back((request.update ? update : judge)(regressions[i], runs[i], (*finished)[i]));
  }
  fmt::print("{}", table_of(outcomes));
  write_junit(outcomes, request.out / "junit.xml");
  return std::ranges::any_of(outcomes, &Outcome::bad) ? core::ExitCode::regression : core::ExitCode::success;
}

}  // namespace talus::coupler::regress
