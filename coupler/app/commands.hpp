#pragma once

#include <functional>
#include <vector>

#include "core/errors.hpp"

namespace CLI {
class App;
}

/// The subcommands of `talus`.
namespace talus::coupler {

/// What the command line asks for, set by the subcommand that was named.
struct Chosen {
  std::function<core::ExitCode()> run;
};

/// Adds a subcommand with its options to the application.
using AddSubcommand = void (*)(CLI::App& app, Chosen& chosen);

inline constexpr const char* trust_help =
    "start the programs that the scene names and ask them; else only Talus's own sides are asked";

void add_run(CLI::App& app, Chosen& chosen);
void add_check(CLI::App& app, Chosen& chosen);
void add_explain(CLI::App& app, Chosen& chosen);
void add_regress(CLI::App& app, Chosen& chosen);
void add_schema(CLI::App& app, Chosen& chosen);
void add_report(CLI::App& app, Chosen& chosen);
void add_study(CLI::App& app, Chosen& chosen);
void add_tune(CLI::App& app, Chosen& chosen);
void add_barrier(CLI::App& app, Chosen& chosen);
void add_mesh(CLI::App& app, Chosen& chosen);
void add_homogenise(CLI::App& app, Chosen& chosen);
void add_version(CLI::App& app, Chosen& chosen);

/// All of them, in the order of the help page.
const std::vector<AddSubcommand>& subcommands();

}  // namespace talus::coupler
