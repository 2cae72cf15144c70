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

/// False where a stop was requested.
bool run_points(const std::vector<PlannedRun>& runs, const RunnerOptions& options,
                const StudyRequest& request) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (static_cast<int>(i) % request.parts != request.part) continue;
    if (!run_point(runs[i], options)) return false;
    const auto point = read_point(runs[i], options.folder);
    core::log_info(fmt::format("{} of {}: {} {}", i + 1, runs.size(), runs[i].id,
                               point.at("outcome").get<std::string>()));
  }
  return true;
}

void write_pages(const LoadedStudy& study, const std::vector<PlannedRun>& runs, const fs::path& folder) {
  nlohmann::json analysis = analyse(study, runs, folder / "runs");
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
  const fs::path folder = folder_of(request);
  const RunnerOptions options = runner_options(study.scene, request);
  const auto runs = plan(study.scene, options.folder);
  fs::create_directories(options.folder);
  pin_to_cores(static_cast<int>(study.scene.cores));
  if (!request.page_only && !run_points(runs, options, request)) return core::ExitCode::interrupted;
  write_pages(study, runs, folder);
  return core::ExitCode::success;
}

}  // namespace talus::study
