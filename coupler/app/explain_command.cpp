#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "coupler/app/commands.hpp"
#include "coupler/explain/explain.hpp"
#include "coupler/run/inspect.hpp"

namespace talus::coupler {
namespace {

core::ExitCode explain_result(const std::filesystem::path& folder) {
  fmt::print("{}", explain::explanation(explain::read_facts(folder)));
  return core::ExitCode::success;
}

}  // namespace

void add_explain(CLI::App& app, Chosen& chosen) {
  auto* command = app.add_subcommand(
      "explain",
      "print which effects are in a scene and why; of a result also what each cost, and what could be left "
      "out or seems to be missing");
  command->footer(
      "Example:\n  talus explain configs/examples/cable_net.yaml\n  talus explain results/cable_net");
  const auto path = std::make_shared<std::filesystem::path>();
  command->add_option("SCENE_OR_RESULT", *path, "a scene (a YAML file) or the folder of a result")
      ->required();
  command->callback([path, &chosen] {
    chosen.run = [path] {
      return std::filesystem::is_directory(*path) ? explain_result(*path) : explain_scene(*path);
    };
  });
}

}  // namespace talus::coupler
