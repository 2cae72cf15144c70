#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <catch2/catch.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>

#include "core/parallel.hpp"
#include "core/program/command_line.hpp"
#include "core/program/log.hpp"
#include "core/program/progress.hpp"
#include "core/program/stop.hpp"
#include "tests/support/folder.hpp"

namespace talus {
namespace {

using core::ExitCode;

int code(ExitCode c) {
  return static_cast<int>(c);
}

/// Runs a solver whose run is `run`, with its output thrown away, in a process of its own.
int exit_of(const std::vector<const char*>& arguments,
            const std::function<ExitCode(const core::SolverCommand&)>& run) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::freopen("/dev/null", "w", stdout);
    std::freopen("/dev/null", "w", stderr);
    std::vector<const char*> all{"solver"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    ::_exit(core::solver_main(
        static_cast<int>(all.size()), all.data(),
        {"solver", "solves", "solver scene.yaml", [] { return std::string("# keys\n"); }, run}));
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}
int exit_of_throwing(const std::function<void()>& thrower) {
  return exit_of({"scene.yaml"}, [&](const auto&) { return thrower(), ExitCode::success; });
}

/// What is printed to the stream by `print`.
template <class Print>
std::string printed(Print&& print) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* stream = open_memstream(&text, &size);
  print(stream);
  std::fclose(stream);
  const std::string result(text, size);
  std::free(text);
  return result;
}

}  // namespace

TEST_CASE("each kind of error has its exit code") {
  CHECK(exit_of_throwing([] { throw core::ConfigError("bad scene"); }) == code(ExitCode::config));
  CHECK(exit_of_throwing([] {
          throw core::TransportError({.peer = "p", .waited_for = "w", .reason = "died"});
        }) == code(ExitCode::transport));
  CHECK(exit_of_throwing([] { throw core::NumericalError({.what = "x", .entity = "node 1"}); }) ==
        code(ExitCode::numerical));
  CHECK(exit_of_throwing([] { throw core::FileError("a/b.csv", "written", ENOSPC); }) ==
        code(ExitCode::machine));
  CHECK(exit_of_throwing([] { std::filesystem::create_directory("/proc/none"); }) == code(ExitCode::machine));
  CHECK(exit_of_throwing([] { throw std::bad_alloc(); }) == code(ExitCode::machine));
  CHECK(exit_of_throwing([] { throw std::runtime_error("odd"); }) == code(ExitCode::bug));
  CHECK(exit_of_throwing([] { throw 3; }) == code(ExitCode::bug));
  CHECK(exit_of({"scene.yaml"}, [](const auto&) { return ExitCode::interrupted; }) ==
        code(ExitCode::interrupted));
}

TEST_CASE("a wrong command line is a configuration error, and asking for help is none") {
  const auto never = [](const core::SolverCommand&) -> ExitCode { ::_exit(99); };
  CHECK(exit_of({}, never) == code(ExitCode::config));
  CHECK(exit_of({"scene.yaml", "--threads", "0"}, never) == code(ExitCode::config));
  CHECK(exit_of({"scene.yaml", "--no-such-option"}, never) == code(ExitCode::config));
  CHECK(exit_of({"scene.yaml", "--quiet", "--json"}, never) == code(ExitCode::config));
  CHECK(exit_of({"--help"}, never) == 0);
  CHECK(exit_of({"--version"}, never) == 0);
  CHECK(exit_of({"--schema"}, never) == 0);
}

TEST_CASE("the options of a solver reach its run") {
  const auto check = [](const core::SolverCommand& command) {
    const bool as_given = command.scene == "a/net.yaml" && command.run.folder_for(command.scene) == "there" &&
                          command.run.existing == core::ResultFolder::Existing::replace &&
                          core::thread_count() == 3 && command.run.progress == core::ProgressStyle::json &&
                          command.join == "segment";
    return as_given ? ExitCode::success : ExitCode::bug;
  };
  CHECK(exit_of(
            {"a/net.yaml", "--out", "there", "--overwrite", "--threads", "3", "--json", "--join", "segment"},
            check) == 0);
  CHECK(core::RunOptions{}.folder_for("a/net.yaml") == "results/net");
}

TEST_CASE("each signal that asks a run to end does so however often it comes, and a second Ctrl-C kills") {
  const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2);
  ::signal(SIGHUP, SIG_DFL);  // the tests may run under nohup
  const auto asked = [signal](const auto&) {
    ::raise(signal);
    ::raise(signal);  // as `timeout` does: to the program, then to its group
    const bool named = core::stop_reason() == std::string("stopped by SIG") + sigabbrev_np(signal);
    return core::stop_requested() && named ? ExitCode::interrupted : ExitCode::bug;
  };
  CHECK(exit_of({"scene.yaml"}, asked) == code(ExitCode::interrupted));
  const auto later = [&](const auto& command) {
    const ExitCode first = asked(command);
    ::usleep(600'000);  // half a second tells the second press of a key from a signal that comes twice
    return ::raise(signal), first;
  };
  CHECK(exit_of({"scene.yaml"}, later) == (signal == SIGINT ? -SIGINT : code(ExitCode::interrupted)));
}

TEST_CASE("a joined solver leaves the signals that ask a run to end to its commander") {
  const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGPIPE);
  const auto ignored = [signal](const auto&) {
    return ::raise(signal), core::stop_requested() ? ExitCode::bug : ExitCode::success;
  };
  CHECK(exit_of({"scene.yaml", "--join", "segment"}, ignored) == 0);
}

TEST_CASE("a program started with nohup goes on when its terminal is closed") {
  const auto closed = [](const auto&) {
    return ::raise(SIGHUP), core::stop_requested() ? ExitCode::bug : ExitCode::success;
  };
  ::signal(SIGHUP, SIG_IGN);
  CHECK(exit_of({"scene.yaml"}, closed) == 0);
  ::signal(SIGHUP, SIG_DFL);
}

TEST_CASE("messages reach the screen when log.txt cannot be written any more") {
  const test::Folder folder("full_log");
  CHECK(exit_of_throwing([&] {
          core::open_log_file(folder / "log.txt");
          const rlimit as_it_is{std::filesystem::file_size(folder / "log.txt"), RLIM_INFINITY};
          if (::setrlimit(RLIMIT_FSIZE, &as_it_is) != 0) ::_exit(99);  // of this child process
          core::log_error("said to a full disk");
          throw core::ConfigError("the first cause");
        }) == code(ExitCode::config));
}

TEST_CASE("log.txt holds what was said before it was opened, and nothing below info") {
  test::Folder folder("log");
  core::show_log_from(core::LogLevel::error);
  core::log_warning("said early");
  core::open_log_file(folder / "log.txt");
  core::log_debug("too small");
  core::log_info("said late");
  const std::string text = test::text_of(folder / "log.txt");
  CHECK_THAT(text, Catch::Contains(" warning said early\n") && Catch::Contains(" info said late\n"));
  CHECK_THAT(text, !Catch::Contains("too small"));
  core::show_log_from(core::LogLevel::info);
}

TEST_CASE("the progress line says where the run is, how fast it is and what is left") {
  const core::ProgressState state{
      .time = 0.05, .end = 0.2, .steps = 1000, .energy_error = -2.5e-5, .limit = "cable net"};
  // 0.05 s simulated in 0.025 s is twice real time; 0.15 s more take 0.075 s, shown as a full second.
  CHECK(core::progress_line(state, "windows", 0.025) ==
        "0.05 / 0.2 s  1000 windows  2 x real time  energy error -2.5e-05  limited by cable net  1 s left");
  const auto json = nlohmann::json::parse(core::progress_json(state, "windows", 0.025));
  CHECK(json["time_s"] == 0.05);
  CHECK(json["windows"] == 1000);
  CHECK(json["real_time_factor"].get<double>() == Approx(2));
  CHECK(json["seconds_left"].get<double>() == Approx(0.075));
  CHECK(json["limited_by"] == "cable net");
}

TEST_CASE("progress is silent where asked, redraws one line on a terminal and prints whole lines elsewhere") {
  const auto run = [](core::ProgressStyle style) {
    return printed([&](std::FILE* stream) {
      core::Progress progress(style, "steps", stream);
      for (int i = 0; i <= 1000; ++i) progress.update({.time = i * 1e-3, .end = 1, .steps = i, .limit = {}});
      progress.finish({.time = 1, .end = 1, .steps = 1000, .limit = {}});
    });
  };
  CHECK(run(core::ProgressStyle::quiet).empty());
  const std::string line = run(core::ProgressStyle::line);
  CHECK(line.front() == '\r');
  CHECK(std::count(line.begin(), line.end(), '\n') == 1);
  const std::string rare = run(core::ProgressStyle::rare);
  CHECK(std::count(rare.begin(), rare.end(), '\n') <= 3);  // the loop is over in far less than a second
  CHECK(run(core::ProgressStyle::automatic).find('\r') == std::string::npos);
  std::istringstream objects(run(core::ProgressStyle::json));
  for (std::string text; std::getline(objects, text);) CHECK(nlohmann::json::parse(text)["end_s"] == 1.0);
}

}  // namespace talus
