#include "coupler/app/commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/program/command_line.hpp"
#include "core/program/log.hpp"
#include "coupler/accuracy/error_bars.hpp"
#include "coupler/run/inspect.hpp"
#include "coupler/run/run_scene.hpp"
#include "coupler/study/load.hpp"

namespace talus::coupler {

const std::vector<AddSubcommand>& subcommands() {
  static const std::vector<AddSubcommand> all{add_run,     add_check, add_explain,    add_report,
                                              add_study,   add_tune,  add_regress,    add_schema,
                                              add_barrier, add_mesh,  add_homogenise, add_version};
  return all;
}

namespace {

struct RunCommand {
  RunRequest run;
  bool error_bars = false;
};

/// The cores that nobody keeps busy, one at least.
int idle_cores() {
  const double others = study::OtherLoad().now();
  return std::max(1, static_cast<int>(std::lround(std::thread::hardware_concurrency() - others)));
}

core::ExitCode run_with_error_bars(const RunRequest& request) {
  const core::ExitCode code = run_scene(request);
  if (code != core::ExitCode::success) return code;
  const auto result = request.options.folder_for(request.scene);
  const bool done = accuracy::add_error_bars({.scene = request.scene,
                                              .result = result,
                                              .program = std::filesystem::read_symlink("/proc/self/exe"),
                                              .jobs = idle_cores()});
  if (!done) return core::ExitCode::interrupted;
  core::log_info(
      accuracy::words_about_error_bars(nlohmann::json::parse(std::ifstream(result / "summary.json"))));
  return core::ExitCode::success;
}

}  // namespace

void add_run(CLI::App& app, Chosen& chosen) {
  auto* command = app.add_subcommand("run", "compute a scene and write its result");
  const auto request = std::make_shared<RunCommand>();
  command->add_option("SCENE", request->run.scene, "the scene, a YAML file")->required();
  core::add_run_options(*command, request->run.options);
  auto* restart = command->add_option(
      "--restart", request->run.restart,
      "go on from this checkpoint.h5; the result goes to results/<scene>_restarted or --out, with "
      "the rows before the checkpoint");
  const std::map<std::string, Role> sides{{"structure", Role::structure}, {"particles", Role::particles}};
  auto* wait =
      command
          ->add_option(
              "--wait", request->run.by_hand,
              "wait for this side (structure, particles) to be started by hand; its command is printed")
          ->transform(CLI::CheckedTransformer(sides));
  command
      ->add_flag(
          "--error-bars", request->error_bars,
          "then run companions at other steps, windows and meshes on the idle cores, and give every peak "
          "its numerical error (docs/accuracy.md)")
      ->excludes(restart)
      ->excludes(wait);
  command->callback([request, &chosen] {
    chosen.run = [request] {
      core::apply(request->run.options);
      return request->error_bars ? run_with_error_bars(request->run) : run_scene(request->run);
    };
  });
}

void add_check(CLI::App& app, Chosen& chosen) {
  auto* command = app.add_subcommand(
      "check", "print every step limit of a scene; exit code 2 where a stability limit is exceeded");
  command->footer("Example:\n  talus check configs/examples/cable_net.yaml");
  const auto request = std::make_shared<InspectRequest>();
  command->add_option("SCENE", request->scene, "the scene, a YAML file")->required();
  command->add_flag("--trust", request->trust, trust_help);
  command->callback([request, &chosen] { chosen.run = [request] { return check_scene(*request); }; });
}

void add_schema(CLI::App& app, Chosen& chosen) {
  auto* command = app.add_subcommand("schema", "print all keys of a scene as Markdown (docs/schema.md)");
  command->footer("Example:\n  talus schema > docs/schema.md");
  command->callback([&chosen] { chosen.run = print_schema; });
}

void add_version(CLI::App& app, Chosen& chosen) {
  app.add_subcommand("version", "print the version")->callback([&chosen] {
    chosen.run = [] {
      fmt::print("talus {}\n", core::version());
      return core::ExitCode::success;
    };
  });
}

}  // namespace talus::coupler
