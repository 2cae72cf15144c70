#include "coupler/study/study.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/output/file.hpp"
#include "core/program/command_line.hpp"
#include "core/program/log.hpp"
#include "core/program/stop.hpp"
#include "coupler/page/page.hpp"
#include "coupler/study/analysis.hpp"
#include "coupler/study/runner.hpp"

namespace talus::study {

extern const char* const study_page_template;

namespace {

namespace fs = std::filesystem;

fs::path folder_of(const StudyRequest& request) {
  return request.out.empty() ? fs::path("results") / request.study.stem() : request.out;
}

RunnerOptions runner_options(const StudyScene& study, const StudyRequest& request) {
  return {
      .program = request.program.empty() ? fs::read_symlink("/proc/self/exe") : fs::absolute(request.program),
      .folder = folder_of(request) / "runs",
      .repeats = static_cast<int>(study.repeats),
      .threads = static_cast<int>(study.threads),
      .time_limit = study.time_limit};
}

/// The points of this share: every `parts`-th value of the sweep, with all methods, so that the times that are compared
/// are of one machine.
std::vector<const PlannedRun*> share_of(const std::vector<PlannedRun>& runs, const StudyRequest& request) {
  std::vector<const PlannedRun*> share;
  const auto groups = interleaved(runs);
  for (std::size_t g = static_cast<std::size_t>(request.part); g < groups.size();
       g += static_cast<std::size_t>(request.parts))
    for (const std::size_t i : groups[g]) share.push_back(&runs[i]);
  return share;
}

/// All points once, then all once more, so that every repetition of a point is of another minute.
/// @returns false where a stop was requested
bool run_points(const std::vector<const PlannedRun*>& runs, const RunnerOptions& options) {
  Runner runner(options);
  for (int round = 1; round <= options.repeats; ++round) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (!runner.run_up_to(round, *runs[i])) return false;
      if (round > 1) continue;
      const auto point = read_point(*runs[i], options.folder);
      core::log_info(fmt::format("{} of {}: {} {}", i + 1, runs.size(), runs[i]->id,
                                 point.at("ending").get<std::string>()));
    }
    core::log_info(fmt::format("round {} of {} is done", round, options.repeats));
  }
  return true;
}

void write_pages(const LoadedStudy& study, const std::vector<PlannedRun>& runs,
                 const RunnerOptions& options) {
  const fs::path folder = options.folder.parent_path();
  Fingerprints fingerprints(options.program, options.folder, options.threads);
  nlohmann::json analysis = analyse(study, runs, {.folder = options.folder, .fingerprints = fingerprints});
  analysis["program"] = "talus " + core::version();
  core::replace_file(folder / "study.json", analysis.dump(1) + "\n");
  core::replace_file(folder / "study.csv", to_csv(analysis));
  core::replace_file(folder / "index.html", page::make(study_page_template, study.title, analysis));
  core::log_info("the page of the study is " + (folder / "index.html").string());
}

}  // namespace

core::ExitCode run_study(const StudyRequest& request) {
  core::watch_stop_signals("with the run in progress");
  if (request.parts < 1 || request.part < 0 || request.part >= request.parts)
    throw core::ConfigError("--part wants I/N with I from 1 to N");
  const LoadedStudy study = load_study(request.study);
  const RunnerOptions options = runner_options(study.scene, request);
  const auto runs = plan(study.scene, options.folder);
  fs::create_directories(options.folder);
  pin_to_cores(static_cast<int>(study.scene.cores));
  if (!request.page_only && !run_points(share_of(runs, request), options)) return core::ExitCode::interrupted;
  write_pages(study, runs, options);
  return core::ExitCode::success;
}

}  // namespace talus::study
