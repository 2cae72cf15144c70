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
  const auto request = std::make_shared<InspectRequest>();
  command->add_option("SCENE_OR_RESULT", request->scene, "a scene (a YAML file) or the folder of a result")
      ->required();
  command->add_flag("--trust", request->trust, trust_help);
  command->callback([request, &chosen] {
    chosen.run = [request] {
      return std::filesystem::is_directory(request->scene) ? explain_result(request->scene)
                                                           : explain_scene(*request);
    };
  });
}

}  // namespace talus::coupler
