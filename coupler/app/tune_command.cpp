#include <CLI/CLI.hpp>
#include <memory>

#include "coupler/app/commands.hpp"
#include "coupler/tune/tune.hpp"

namespace talus::coupler {

void add_tune(CLI::App& app, Chosen& chosen) {
  auto* command =
      app.add_subcommand("tune", "find the cheapest settings of a scene that have a wanted accuracy");
  command->footer(
      "Example:\n  talus tune configs/examples/cable_net.yaml --within '2 % of peak "
      "net_centre.displacement_z_m'");
  const auto request = std::make_shared<tune::TuneRequest>();
  command->add_option("SCENE", request->scene, "the scene, a YAML file")->required();
  command
      ->add_option("--within", request->within,
                   "a goal: 'X % of peak COLUMN', with a column of probes.csv, or 'X % of energy'; may be "
                   "given several times")
      ->required()
      ->allow_extra_args(false);
  command->add_option("--budget", request->budget, "minutes of wall time")->capture_default_str();
  command->add_option(
      "--out", request->out,
      "folder of the runs, the page and the tuned scene (default: results/<scene>_tune); one that holds an "
      "earlier search is gone on with");
  command->add_option("--threads", request->threads, "threads of each solver")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->callback([request, &chosen] { chosen.run = [request] { return tune::tune(*request); }; });
}

}  // namespace talus::coupler
