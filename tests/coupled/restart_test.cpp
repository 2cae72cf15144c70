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
  enum class To { program, group };
  void stop(const std::string& name, int signal, std::chrono::milliseconds later, To to = To::program) const {
    const auto program = start(name);
    const auto deadline = std::chrono::steady_clock::now() + limit;
    while (!std::filesystem::exists(folder(name) / "checkpoint.h5")) {
      REQUIRE(std::chrono::steady_clock::now() < deadline);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(later);
    to == To::group ? program->signal_group(signal) : program->signal(signal);
    program->wait(limit);
  }
  /// Lays `yaml` over the scene for the runs that follow.
  void change(const std::string& yaml) const {
    const auto base = folder_.path() / "base.yaml";
    std::filesystem::rename(scene_, base);
    std::ofstream(scene_) << "extends: base.yaml\n" << yaml << "\n";
  }
  /// A run started by a user who stands in the folder of a result.
  test::Ended restart_from_within(const std::string& name, const std::string& options) const {
    const std::string command = "cd '" + folder(name).string() +
                                "' && exec " TALUS_BINARY_DIR "/bin/talus run '" + scene_.string() +
                                "' --quiet " + options;
    return test::Program({"/bin/sh", "-c", command}, folder(name).string() + "_within.txt").wait(limit);
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
  CHECK_THAT(end.output, Contains("is the folder of the checkpoint"));
}

TEST_CASE("a restart from within the folder of the checkpoint leaves the result it comes from as it is") {
  const Example example(hanging_net);
  example.stop("stopped", SIGINT, std::chrono::milliseconds(0));
  const std::string before = test::text_of(example.folder("stopped") / "probes.csv");
  const auto end = example.restart_from_within("stopped", "--restart checkpoint.h5 --out . --overwrite");
  CHECK(end.code == 2);
  CHECK_THAT(end.output, Contains("is the folder of the checkpoint"));
  CHECK(test::text_of(example.folder("stopped") / "probes.csv") == before);
  CHECK(std::filesystem::exists(example.folder("stopped") / "checkpoint.h5"));
}

TEST_CASE("a signal to the whole process group leaves a checkpoint of the moment it came") {
  const Example example(hanging_net);
  example.run("whole");
  example.stop("stopped", SIGTERM, std::chrono::milliseconds(30), Example::To::group);
  CHECK_THAT(test::text_of(example.folder("stopped") / "summary.json"), Contains("\"interrupted\""));
  example.run("restarted", "stopped");
  example.check_same_tables("restarted", "whole");
}

TEST_CASE("the checkpoint before the last is kept, and a run can go on from it, too") {
  const Example example(hanging_net);
  example.run("whole");
  example.stop("stopped", SIGKILL, std::chrono::milliseconds(100));
  std::filesystem::copy(example.folder("stopped"), example.folder("older"));
  std::filesystem::rename(example.folder("older") / "checkpoint_before.h5",
                          example.folder("older") / "checkpoint.h5");
  example.run("restarted", "older");
  example.check_same_tables("restarted", "whole");
}

TEST_CASE("a restart names the keys of a scene that changed, and refuses a state that it would ignore") {
  const Example example(rock_on_net);
  example.stop("stopped", SIGINT, std::chrono::milliseconds(20));
  SECTION("a density") {
    example.change("particles: {materials: {rock: {density: 2600 kg/m^3}}}");
    const auto end = example.start("restarted", "stopped")->wait();
    CHECK(end.code == 0);
    CHECK_THAT(end.output,
               Contains("particles.materials.rock.density: 2600 kg/m^3, in the checkpoint 2500 kg/m^3"));
  }
  SECTION("a velocity") {
    example.change("particles: {spheres: {stone: {velocity: [0, 0, -25 m/s]}}}");
    const auto end = example.start("restarted", "stopped")->wait();
    CHECK(end.code == 2);
    CHECK_THAT(end.output,
               Contains("particles.spheres.stone.velocity[2]: -25 m/s, in the checkpoint -5.74029"));
    CHECK_FALSE(std::filesystem::exists(example.folder("restarted")));
  }
  SECTION("a structure of other nodes") {
    example.change("structure: {parts: {net: {square_net: {pitch: 0.3 m}}}}");
    const auto end = example.start("restarted", "stopped")->wait();
    CHECK(end.code == 2);
    CHECK_THAT(end.output,
               Contains("structure.parts.net.square_net.pitch: 0.3 m, in the checkpoint 0.15 m") &&
                   Contains("take these back"));
  }
  SECTION("an end before the checkpoint") {
    example.change("time: {end: 100 us}");
    const auto end = example.start("restarted", "stopped")->wait();
    CHECK(end.code == 2);
    CHECK_THAT(end.output, Contains("error: time.end: 0.0001 s lies before the time of the checkpoint"));
    CHECK(std::count(end.output.begin(), end.output.end(), '\n') == 1);
  }
}
