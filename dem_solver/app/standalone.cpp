#include "dem_solver/app/standalone.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/output/result_writer.hpp"
#include "core/program/log.hpp"
#include "core/program/progress.hpp"
#include "core/program/stop.hpp"
#include "core/steps.hpp"
#include "dem_solver/app/particle_run.hpp"

namespace talus::dem {

namespace {

/// Steps between two outputs that are `interval` apart.
std::int64_t steps_between(double interval, double step) {
  return std::max<std::int64_t>(1, std::llround(interval / step));
}

struct Schedule {
  std::int64_t steps = 0, row_every = 1, frame_every = 0;  ///< frame_every 0: no fields

  Schedule(const RunScene& scene, double step) : steps(core::steps_in(scene.time.end, step)) {
    const double every = scene.output && scene.output->every > 0 ? scene.output->every : scene.time.end / 200;
    row_every = steps_between(every, step);
    if (scene.output && scene.output->fields_every)
      frame_every = steps_between(*scene.output->fields_every, step);
  }
  std::int64_t frames() const { return frame_every == 0 ? 0 : steps / frame_every + 2; }
};

const ParticleStepLimit* tightest(const std::vector<ParticleStepLimit>& limits) {
  const auto found = std::ranges::min_element(limits, {}, &ParticleStepLimit::seconds);
  return found == limits.end() ? nullptr : &*found;
}

void check_step(const RunScene& scene, const ParticleRun& run) {
  const double step = run.solver.step_length();
  for (const ParticleStepLimit& limit : run.limits) {
    if (step <= limit.seconds) continue;
    const std::string message = fmt::format("the step of {:.4g} s is above the limit of {:.4g} s: {} ({})",
                                            step, limit.seconds, limit.name, limit.reason);
    if (limit.stability && scene.particles.unstable_step == ParticlesScene::UnstableStep::refused)
      throw core::ConfigError(message + "; `unstable_step: allowed` runs it all the same");
    core::log_warning(message);
  }
}

void summarize(nlohmann::json& summary, const ParticleRun& run) {
  for (const ParticleStepLimit& limit : run.limits)
    summary["limits"].push_back({{"name", limit.name},
                                 {"seconds", limit.seconds},
                                 {"stability", limit.stability},
                                 {"reason", limit.reason}});
  summary["step_s"] = run.solver.step_length();
  summary["steps"] = run.solver.steps_done();
  summary["neighbour_searches"] = run.solver.searches();
}

core::RunStatus advance(ParticleRun& run, const RunScene& scene, core::ResultWriter& results,
                        core::Progress& progress) {
  const Schedule schedule(scene, run.solver.step_length());
  const ParticleStepLimit* limit = tightest(run.limits);
  const auto write = [&](std::int64_t n) {
    if (n % schedule.row_every == 0 || n == schedule.steps) results.write_row(run.solver.time());
    if (schedule.frame_every > 0 && (n % schedule.frame_every == 0 || n == schedule.steps))
      results.write_fields(run.solver.time());
  };
  const auto state = [&] {
    return core::ProgressState{.time = run.solver.time(),
                               .end = scene.time.end,
                               .steps = run.solver.steps_done(),
                               .energy_error = results.balance().last().error_relative,
                               .limit = limit ? limit->name : ""};
  };
  write(0);
  while (run.solver.steps_done() < schedule.steps && !core::stop_requested()) {
    run.solver.step();
    write(run.solver.steps_done());
    progress.update(state());
  }
  progress.finish(state());
  return run.solver.steps_done() < schedule.steps ? core::RunStatus::interrupted : core::RunStatus::finished;
}

}  // namespace

core::ExitCode run_standalone(const core::SolverCommand& command) {
  const core::SceneFile file = core::SceneFile::load(command.scene);
  const RunScene scene = read_run_scene(file);
  if (!own_step(scene))
    throw core::ConfigError("the particles have no step: give time.step or particles.step");
  ParticleRun run(scene, make_surface(scene.particles.boundaries), {});
  run.solver.set_clock({.time = 0, .step = core::equal_steps(scene.time.end, *own_step(scene)).length});
  check_step(scene, run);
  core::ResultWriter results({.folder = command.run.folder_for(command.scene),
                              .existing = command.run.existing,
                              .title = command.scene.stem(),
                              .program = "dem_solver " + core::version(),
                              .scene = command.scene,
                              .scene_hash = file.hash(),
                              .frame_capacity = Schedule(scene, run.solver.step_length()).frames(),
                              .energy_error = scene.output.value_or(core::OutputScene{}).energy_error()},
                             {&run.output});
  if (const auto words = core::words_about_length("step", scene.time.end, *own_step(scene)); !words.empty())
    core::log_warning(words);
  core::Progress progress(command.run.progress, "steps");
  try {
    const core::RunStatus status = advance(run, scene, results, progress);
    summarize(results.summary(), run);
    results.finish(status, status == core::RunStatus::interrupted ? core::stop_reason() : "");
    return status == core::RunStatus::finished ? core::ExitCode::success : core::ExitCode::interrupted;
  } catch (const core::NumericalError& error) {
    core::NumericalError::Details details = error.details();
    details.last_output_time = results.last_row_time().value_or(-1);
    const core::NumericalError complete(details);
    summarize(results.summary(), run);
    results.give_up(complete.what());
    throw complete;
  } catch (const std::exception& error) {
    results.give_up(error.what());
    throw;
  }
}

}  // namespace talus::dem
