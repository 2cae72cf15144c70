#include <signal.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <random>
#include <thread>

#include "tests/support/program.hpp"

using namespace talus;
using Catch::Matchers::Contains;

namespace {

/// A scene of the examples, run by `talus run` with checkpoints.
class Example {
 public:
  struct Course {
    const char *name, *window, *end, *checkpoint_every, *more = "";
  };
  explicit Example(const Course& course) {
    std::ofstream(scene_) << "extends: " << TALUS_SOURCE_DIR << "/configs/examples/" << course.name
                          << ".yaml\n"
                          << "time: {end: " << course.end << "}\n"
                          << "output: {fields_every: 0.1 s, every: 2 ms}\n"
                          << "coupling: {window: " << course.window
                          << ", checkpoint_every: " << course.checkpoint_every << "}\n"
                          << course.more;
  }
  std::filesystem::path folder(const std::string& name) const { return folder_.path() / name; }

  std::unique_ptr<test::Program> start(const std::string& name, const std::string& restart = {}) const {
    std::vector<std::string> command{TALUS_BINARY_DIR "/bin/talus", "run",    scene_.string(), "--out",
                                     folder(name).string(),         "--quiet"};
    if (!restart.empty())
      command.insert(command.end(), {"--restart", (folder(restart) / "checkpoint.h5").string()});
    return std::make_unique<test::Program>(command, folder(name).string() + ".txt");
  }
  void run(const std::string& name, const std::string& restart = {}) const {
    const auto end = start(name, restart)->wait(limit);
    INFO(end.output);
    REQUIRE(end.code == 0);
  }
  /// Starts a run and ends it by a signal a while after its first checkpoint.
  void stop(const std::string& name, int signal, std::chrono::milliseconds later) const {
    const auto program = start(name);
    const auto deadline = std::chrono::steady_clock::now() + limit;
    while (!std::filesystem::exists(folder(name) / "checkpoint.h5")) {
      REQUIRE(std::chrono::steady_clock::now() < deadline);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(later);
    program->signal(signal);
    program->wait(limit);
  }
  void check_same_tables(const std::string& name, const std::string& other) const {
    for (const char* table : {"probes.csv", "energy.csv"}) {
      INFO(table);
      CHECK(test::text_of(folder(name) / table) == test::text_of(folder(other) / table));
    }
  }

 private:
  static constexpr std::chrono::seconds limit{100};
  test::Folder folder_{"restart"};
  std::filesystem::path scene_ = folder_.path() / "scene.yaml";
};

constexpr Example::Course hanging_net{"hanging_net", "1 ms", "0.3 s", "1 us"},
    implicit_net{"hanging_net_implicit", "4 ms", "0.3 s", "1 us"},
    rock_on_net{"cable_net", "50 us", "0.08 s", "20 ms",  // moved close: it touches the net from 2 ms on
                "particles: {spheres: {boulder: {at: [1.5, 1.729, 0.22]}}}\n"},
    rock_in_flight{"cable_net", "50 us, longest_window: 0.7 ms", "0.05 s", "5 ms"};

}  // namespace

TEST_CASE(
    "a run killed at a random moment and restarted from its last checkpoint has the tables of a whole run") {
  const Example example(GENERATE(hanging_net, implicit_net, rock_on_net, rock_in_flight));
  example.run("whole");
  std::mt19937 random(11);
  for (int k = 0; k < 2; ++k) {
    const std::string stopped = "stopped" + std::to_string(k), restarted = "restarted" + std::to_string(k);
    example.stop(stopped, SIGKILL, std::chrono::milliseconds(random() % 200));
    example.run(restarted, stopped);
    example.check_same_tables(restarted, "whole");
  }
}

TEST_CASE("Ctrl-C leaves a checkpoint, and the restarted run says where it comes from") {
  const Example example(hanging_net);
  example.run("whole");
  example.stop("stopped", SIGINT, std::chrono::milliseconds(30));
  example.run("restarted", "stopped");
  example.check_same_tables("restarted", "whole");
  CHECK_THAT(test::text_of(example.folder("restarted") / "summary.json"), Contains("rows_taken_over"));
}

TEST_CASE("a restart does not write over the result it comes from") {
  const Example example(hanging_net);
  example.stop("stopped", SIGINT, std::chrono::milliseconds(0));
  const auto end = example.start("stopped", "stopped")->wait();
  CHECK(end.code == 2);
  CHECK_THAT(end.output, Contains("--out is the folder of the checkpoint"));
}
