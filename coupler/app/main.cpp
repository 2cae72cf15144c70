#include <CLI/CLI.hpp>

#include "core/program/command_line.hpp"
#include "coupler/app/commands.hpp"

int main(int argc, char** argv) {
  using namespace talus;
  CLI::App app("Rocks hit flexible protection nets: particles and structure, coupled.", "talus");
  app.footer("Example:\n  talus run configs/examples/cable_net.yaml\n\n" + core::exit_code_help());
  app.require_subcommand(1);
  coupler::Chosen chosen;
  for (const auto add : coupler::subcommands()) add(app, chosen);
  return core::run_main(app, argc, argv, [&] { return chosen.run(); });
}
