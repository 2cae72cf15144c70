#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "core/errors.hpp"
#include "core/output/result_folder.hpp"
#include "core/program/progress.hpp"

namespace CLI {
class App;
}

/// What the command lines of all Talus programs have in common.
namespace talus::core {

std::string version();  ///< "0.1.0"

/// --out, --overwrite, --threads, --quiet, --json
struct RunOptions {
  std::filesystem::path out = {};  ///< empty: results/<scene file's stem>
  ResultFolder::Existing existing = ResultFolder::Existing::refuse;
  ProgressStyle progress = ProgressStyle::automatic;
  int threads = 1;

  std::filesystem::path folder_for(const std::filesystem::path& scene) const;
};
void add_run_options(CLI::App& app, RunOptions& options);
/// Sets the number of threads and what the log shows.
void apply(const RunOptions& options);

/// Runs `body` and turns what it throws into a message on the standard error stream and an exit code.
int run_main(const std::string& program, const std::function<ExitCode()>& body) noexcept;
/// Parses the arguments with CLI11 inside of run_main: `--help` and `--version` end with success, a wrong
/// command line with ExitCode::config.
int run_main(CLI::App& app, int argc, const char* const* argv,
             const std::function<ExitCode()>& body) noexcept;

/// A solver's command line: SCENE [--out DIR] [--overwrite] [--quiet] [--json] [--threads N] [--join SEGMENT]
/// | --schema | --version | --help
struct SolverCommand {
  std::filesystem::path scene;
  RunOptions run;
  std::string join;  ///< the segment of a coupled run; empty: standalone
};
struct SolverProgram {
  std::string name;                     ///< "dem_solver"
  std::string purpose;                  ///< one line of the help
  std::string example;                  ///< "dem_solver configs/examples/bouncing_spheres.yaml"
  std::function<std::string()> schema;  ///< the Markdown of its sections
  std::function<ExitCode(const SolverCommand&)> run;
};
/// The whole main() of a solver.
int solver_main(int argc, const char* const* argv, const SolverProgram& program) noexcept;

}  // namespace talus::core
