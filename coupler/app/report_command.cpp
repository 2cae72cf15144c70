#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "coupler/app/commands.hpp"
#include "coupler/report/report.hpp"

namespace talus::coupler {

void add_report(CLI::App& app, Chosen& chosen) {
  auto* command =
      app.add_subcommand("report", "make one page of a result: replay, curves, energies, limits, pictures");
  command->footer("Example:\n  talus report results/cable_net");
  const auto result = std::make_shared<std::filesystem::path>();
  command->add_option("RESULT", *result, "the folder of a result")->required();
  command->callback([result, &chosen] {
    chosen.run = [result] {
      fmt::print("{}\n", report::write_report(*result).string());
      return core::ExitCode::success;
    };
  });
}

}  // namespace talus::coupler
