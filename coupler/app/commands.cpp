#include "coupler/app/commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "core/program/command_line.hpp"
#include "coupler/run/inspect.hpp"
#include "coupler/run/run_scene.hpp"

namespace talus::coupler {

const std::vector<AddSubcommand>& subcommands() {
  static const std::vector<AddSubcommand> all{add_run,   add_check,      add_explain, add_report,
                                              add_study, add_regress,    add_schema,  add_barrier,
                                              add_mesh,  add_homogenise, add_version};
  return all;
}

void add_run(CLI::App& app, Chosen& chosen) {
  auto* command = app.add_subcommand("run", "compute a scene and write its result");
  const auto request = std::make_shared<RunRequest>();
  command->add_option("SCENE", request->scene, "the scene, a YAML file")->required();
  core::add_run_options(*command, request->options);
  command->add_option(
      "--restart", request->restart,
      "go on from this checkpoint.h5; the result goes to results/<scene>_restarted or --out, with "
      "the rows before the checkpoint");
  const std::map<std::string, Role> sides{{"structure", Role::structure}, {"particles", Role::particles}};
  command
      ->add_option("--wait", request->by_hand,
                   "wait for this side (structure, particles) to be started by hand; its command is printed")
      ->transform(CLI::CheckedTransformer(sides));
  command->callback([request, &chosen] {
    chosen.run = [request] {
      core::apply(request->options);
      return run_scene(*request);
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
