#include "core/program/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>
#include <system_error>

#include "core/parallel.hpp"
#include "core/program/faster_build.hpp"
#include "core/program/log.hpp"
#include "core/program/stop.hpp"

namespace talus::core {

std::string version() {
  return TALUS_VERSION;
}

std::filesystem::path RunOptions::folder_for(const std::filesystem::path& scene) const {
  if (!out.empty()) return out;
  const std::filesystem::path name = scene.stem();
  if (name.empty() || name == "." || name == "..")
    throw ConfigError(
        fmt::format("'{}' gives its result no name: say where it goes with --out", scene.string()));
  return std::filesystem::path("results") / name;
}

void add_run_options(CLI::App& app, RunOptions& options) {
  app.add_option("--out", options.out, "folder of the result (default: results/<name of the scene>)");
  app.add_flag_callback(
      "--overwrite", [&] { options.existing = ResultFolder::Existing::replace; },
      "replace an earlier result");
  app.add_option("--threads", options.threads, "threads of each solver; results do not depend on it")
      ->check(CLI::Range(1, 1024));
  auto* quiet = app.add_flag_callback(
      "--quiet", [&] { options.progress = ProgressStyle::quiet; }, "show warnings and errors only");
  app.add_flag_callback(
         "--json", [&] { options.progress = ProgressStyle::json; }, "show progress as one JSON object a line")
      ->excludes(quiet);
}

void apply(const RunOptions& options) {
  set_thread_count(options.threads);
  const bool silent = options.progress == ProgressStyle::quiet || options.progress == ProgressStyle::json;
  show_log_from(silent ? LogLevel::warning : LogLevel::info);
}

namespace {

std::string sentence_of(const std::exception& error, const std::string& program) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
    return program + " ends: this machine has not enough memory for it";
  return exit_code(error) == ExitCode::bug ? fmt::format("{} ends: {}", program, error.what()) : error.what();
}

/// Text that waits for a full disk is lost without a word at the end of a program.
void flush_output() {
  std::cout.flush();
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout)
    throw MachineError("what this program prints cannot be written: is the disk full?");
}

/// fmt reports that a text cannot be printed as an error of the system.
ExitCode run_and_flush(const std::function<ExitCode()>& body) {
  try {
    const ExitCode code = body();
    flush_output();
    return code;
  } catch (const std::filesystem::filesystem_error&) {
    throw;  // which has a code of its own
  } catch (const std::system_error& error) {
    throw MachineError(error.what());
  }
}

}  // namespace

int run_main(const std::string& program, const std::function<ExitCode()>& body) noexcept {
  // A file that outgrows `ulimit -f` is an error of a write like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  const auto code = [](ExitCode c) { return static_cast<int>(c); };
  try {
    return code(run_and_flush(body));
  } catch (const ConfigError& error) {
    for (const auto& complaint : error.complaints()) log_error(complaint.text());
    return code(ExitCode::config);
  } catch (const std::exception& error) {
    const ExitCode which = exit_code(error);
    log_error(sentence_of(error, program));
    return code(which);
  } catch (...) {
    std::fprintf(stderr, "error: %s ends with an exception of no known kind\n", program.c_str());
    return code(ExitCode::bug);
  }
}

int run_main(CLI::App& app, int argc, const char* const* argv,
             const std::function<ExitCode()>& body) noexcept {
  become_faster_build(argv);
  return run_main(app.get_name(), [&] {
    app.set_version_flag("--version", app.get_name() + " " + version());
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return app.exit(error) == 0 ? ExitCode::success : ExitCode::config;
    }
    return body();
  });
}

int solver_main(int argc, const char* const* argv, const SolverProgram& program) noexcept {
  CLI::App app(program.purpose, program.name);
  app.footer("Example:\n  " + program.example + "\n\n" + exit_code_help());
  SolverCommand command;
  bool schema = false;
  auto* scene = app.add_option("SCENE", command.scene, "the scene, a YAML file");
  add_run_options(app, command.run);
  app.add_option("--join", command.join, "take part in the coupled run of this shared-memory segment");
  app.add_flag("--schema", schema, "print the keys of a scene that this program reads, as Markdown");
  return run_main(app, argc, argv, [&] {
    if (schema) {
      fmt::print("{}", program.schema());
      return ExitCode::success;
    }
    if (scene->empty()) throw ConfigError("a scene is needed, for example:  " + program.example);
    apply(command.run);
    command.join.empty() ? watch_stop_signals("at the end of this step") : ignore_stop_signals();
    return program.run(command);
  });
}

}  // namespace talus::core
