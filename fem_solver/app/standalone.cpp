#include "fem_solver/app/standalone.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/output/result_writer.hpp"
#include "core/program/log.hpp"
#include "core/program/stop.hpp"
#include "core/steps.hpp"
#include "core/units/units.hpp"
#include "fem_solver/app/structure.hpp"

namespace talus::fem {
namespace {

constexpr int rows_where_no_interval_is_given = 200;

/// Counts output times in steps, so that none is missed and none comes twice.
class Schedule {
 public:
  Schedule(double interval, double step) : interval_(interval), step_(step) {}
  /// The first step at or after output time number `count`.
  std::int64_t step_of(std::int64_t count) const {
    return static_cast<std::int64_t>(std::ceil(static_cast<double>(count) * interval_ / step_ * (1 - 1e-12)));
  }
  bool is_due(std::int64_t step) {
    if (interval_ <= 0 || step < step_of(next_)) return false;
    while (step_of(next_) <= step) ++next_;
    return true;
  }

 private:
  double interval_, step_;
  std::int64_t next_ = 0;
};

core::ResultWriter::Options writer_options(const core::SolverCommand& command, const core::SceneFile& file,
                                           const StructuralScene& scene) {
  const double every = scene.output.fields_every.value_or(0);
  return {.folder = command.run.folder_for(command.scene),
          .existing = command.run.existing,
          .title = file.title(),
          .program = "fem_solver " + core::version(),
          .scene = command.scene,
          .scene_hash = file.hash(),
          .frame_capacity = every > 0 ? static_cast<std::int64_t>(scene.time.end / every) + 2 : 0,
          .energy_error = scene.output.energy_error()};
}

void report_limits(const Structure& structure, core::ResultWriter& results) {
  auto& limits = results.summary()["limits"];
  limits = nlohmann::json::array();
  for (const auto& bound : structure.bounds()) {
    limits.push_back({{"name", bound.name}, {"seconds", bound.seconds}, {"reason", bound.reason}});
    core::log_info("step limit " + core::readable(bound.seconds, "s") + ": " + bound.name);
  }
  results.summary()["step_s"] = structure.step();
  if (const AddedMass& added = structure.added_mass(); added.nodes > 0)
    results.summary()["mass_scaling"] = {
        {"added_kg", added.kilograms}, {"share", added.share}, {"nodes", added.nodes}};
}

/// All steps of the run. @returns whether it was not interrupted
bool run_steps(Structure& structure, const StructuralScene& scene, core::ResultWriter& results,
               core::Progress& progress) {
  const auto [steps, step] = core::equal_steps(scene.time.end, structure.step());
  const double every =
      scene.output.every > 0 ? scene.output.every : scene.time.end / rows_where_no_interval_is_given;
  Schedule rows(every, step), frames(scene.output.fields_every.value_or(0), step);
  core::ProgressState state{.time = 0,
                            .end = scene.time.end,
                            .steps = 0,
                            .energy_error = 0,
                            .limit = structure.bounds().empty() ? "" : structure.bounds().front().name};
  for (std::int64_t n = 0;; ++n) {
    const double time = static_cast<double>(n) * step;
    const bool ends = n == steps || core::stop_requested();
    if (rows.is_due(n) || ends) {
      results.write_row(time);
      structure.integrator().last_output_time = time;
    }
    if (frames.is_due(n)) results.write_fields(time);
    state = {.time = time,
             .end = state.end,
             .steps = n,
             .energy_error = results.balance().last().error_relative,
             .limit = state.limit};
    if (ends) {
      progress.finish(state);
      return n == steps;
    }
    progress.update(state);
    structure.integrator().advance(time, step);
  }
}

}  // namespace

core::ExitCode run_standalone(const core::SolverCommand& command) {
  const auto file = core::SceneFile::load(command.scene);
  const StructuralScene scene = read_structural_scene(file);
  Structure structure(scene);
  core::ResultWriter results(writer_options(command, file, scene), {&structure.output()});
  report_limits(structure, results);
  if (const auto words = core::words_about_length("step", scene.time.end, structure.step()); !words.empty())
    core::log_warning(words);
  core::Progress progress(command.run.progress, "steps");
  try {
    const bool finished = run_steps(structure, scene, results, progress);
    if (scene.output.final_state)
      structure.write_checkpoint(results.folder() / core::ResultFolder::state_file());
    results.finish(finished ? core::RunStatus::finished : core::RunStatus::interrupted,
                   finished ? "" : core::stop_reason());
    return finished ? core::ExitCode::success : core::ExitCode::interrupted;
  } catch (const std::exception& error) {
    results.give_up(error.what());
    throw;
  }
}

}  // namespace talus::fem
