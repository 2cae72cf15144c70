#include <CLI/CLI.hpp>
#include <memory>

#include "coupler/app/commands.hpp"
#include "coupler/regress/regress.hpp"

namespace talus::coupler {

void add_regress(CLI::App& app, Chosen& chosen) {
  auto* command =
      app.add_subcommand("regress", "run the scenes of a folder and compare them with their baselines");
  command->footer("Example:\n  talus regress configs/regression");
  const auto request = std::make_shared<regress::RegressRequest>();
  command->add_option("DIR", request->folder, "the folder, such as configs/regression")->required();
  command->add_option("--out", request->out, "folder of the results and of junit.xml")->capture_default_str();
  command->add_option("--jobs", request->jobs, "runs side by side; default: as many as there are cores")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--update", request->update, "make the results the new baselines");
  command->callback([request, &chosen] { chosen.run = [request] { return regress::regress(*request); }; });
}

}  // namespace talus::coupler
