#include <signal.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <optional>
#include <regex>
#include <set>
#include <thread>

#include "tests/support/program.hpp"

using namespace talus;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using Catch::Matchers::Matches;

namespace {

/// A fault is noticed within a slice of 50 ms, or the scene's timeout, and everybody is gone within a grace
/// of 1 s. The rest is for a busy machine, on which programs take seconds to start: what is tested is that a
/// run ends at all.
constexpr auto end_limit = 60s;

/// Of one coupler, whose process id is in the name.
std::set<std::string> segments_of(int coupler) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm")) {
    const std::string name = entry.path().filename();
    if (name.starts_with("talus-" + std::to_string(coupler) + "-")) names.insert(name);
  }
  return names;
}

struct Faults {
  std::string structure = "none", particles = "none";
  int at = 20;
  std::string coupling = "timeout: 60 s, join_timeout: 60 s";
  std::string by_hand{};  ///< the side that the test starts itself
};

/// `talus run` on two dummy solvers of which one misbehaves.
class Run {
 public:
  explicit Run(const Faults& faults) {
    std::ofstream scene(folder_.path() / "scene.yaml");
    const auto side = [&](const char* name, const std::string& behaviour) {
      scene << name << ": {solver: " << TALUS_BINARY_DIR << "/bin/dummy_" << name
            << ", behaviour: " << behaviour << ", at: " << faults.at << "}\n";
    };
    scene << "time: {end: 60 s, step: 1 ms}\n";
    side("structure", faults.structure);
    side("particles", faults.particles);
    scene << "interface: {structure: [node], boundary: {same_as_structure: {}}}\n"
          << "coupling: {" << faults.coupling << "}\n"
          << "output: {every: 1 ms}\n";
    scene.close();
    std::vector<std::string> command{TALUS_BINARY_DIR "/bin/talus", "run",
                                     (folder_.path() / "scene.yaml").string(), "--out",
                                     (folder_.path() / "result").string()};
    if (faults.by_hand.empty()) {
      command.push_back("--quiet");
    } else {
      command.insert(command.end(), {"--wait", faults.by_hand});
    }
    program_.emplace(command, folder_.path() / "output.txt");
  }

  /// The command that the run prints for the side it waits for.
  std::vector<std::string> command_by_hand() const {
    std::smatch line;
    const auto deadline = std::chrono::steady_clock::now() + end_limit;
    for (std::string text = output();
         !std::regex_search(text, line, std::regex("\n *(\\S+) (\\S+) --join (talus-\\S+)\n"));
         text = output()) {
      REQUIRE(std::chrono::steady_clock::now() < deadline);
      std::this_thread::sleep_for(5ms);
    }
    return {line[1], line[2], "--join", line[3]};
  }

  /// Sleeps until the run has written rows, one at the start of each window, and remembers who takes part.
  void wait_for_rows(int count = 5) {
    const auto deadline = std::chrono::steady_clock::now() + end_limit;
    while (rows() < count) {
      REQUIRE(std::chrono::steady_clock::now() < deadline);
      std::this_thread::sleep_for(5ms);
    }
    children_ = test::children_of(program_->pid());
    REQUIRE_FALSE(children_.empty());
  }
  int child(const std::string& name) const {
    for (const auto& child : children_) {
      if (child.name.find(name) != std::string::npos) return child.pid;
    }
    FAIL("no child " << name);
    return 0;
  }
  long rows() const {
    const std::string text = test::text_of(folder_.path() / "result/probes.csv");
    return std::count(text.begin(), text.end(), '\n') - 1;
  }
  test::Program& program() { return *program_; }
  const std::vector<test::ChildProcess>& children() const { return children_; }
  std::string output() const { return test::text_of(folder_.path() / "output.txt"); }
  std::string summary() const { return test::text_of(folder_.path() / "result/summary.json"); }

  /// Waits for the end and checks what holds after every fault: nothing is left, and the result says that it
  /// failed.
  test::Ended ended() {
    const auto begin = std::chrono::steady_clock::now();
    const test::Ended end = program_->wait();
    CHECK(std::chrono::steady_clock::now() - begin < end_limit);
    CHECK(test::children_of(program_->pid()).empty());
    for (const auto& child : children_) CHECK_FALSE(test::exists(child.pid));
    CHECK(segments_of(program_->pid()).empty());
    return end;
  }

 private:
  test::TemporaryFolder folder_;
  std::optional<test::Program> program_;
  std::vector<test::ChildProcess> children_;
};

/// Faults must end runs of weak and of strong schemes alike.
const std::vector<std::string> schemes{"serial_explicit: {}", "serial_implicit: {aitken: {}}",
                                       "parallel_implicit: {iqn_ils: {}}"};

constexpr int transport = 3, config = 2, numerical = 4, interrupted = 5;

}  // namespace

TEST_CASE(
    "a solver killed from outside is named with the window and what was waited for, and the other one ends") {
  const std::string victim = GENERATE("structure", "particles");
  Run run({.coupling = GENERATE(from_range(schemes))});
  run.wait_for_rows();
  kill(run.child(victim), SIGKILL);
  const auto end = run.ended();
  CHECK(end.code == transport);
  CHECK_THAT(end.output, Contains(victim + " (dummy_" + victim + ", pid ") &&
                             Contains("was killed by signal 9 (SIGKILL)") && Contains("in window "));
  CHECK_THAT(run.summary(), Contains("\"status\": \"failed\"") && Contains("SIGKILL"));
}

TEST_CASE("a solver that leaves in the middle of a run is named with its exit code") {
  Run run({.structure = "exit", .coupling = GENERATE(from_range(schemes))});
  const auto end = run.ended();
  CHECK(end.code == transport);
  CHECK_THAT(
      end.output,
      Contains("structure (dummy_structure, pid ") &&
          Contains(
              "ended with exit code 7 while the coupler waited for the answer to 'advance' in window 20"));
}

TEST_CASE("a solver that ends before it joins is named with its exit code") {
  Run run({.particles = "exit", .at = -2});
  const auto end = run.ended();
  CHECK(end.code == transport);
  CHECK_THAT(end.output, Contains("particles (dummy_particles, pid ") && Contains("ended with exit code 7"));
}

TEST_CASE("a solver that never joins is named after the join timeout and killed") {
  Run run({.structure = "asleep", .at = -2, .coupling = "join_timeout: 0.5 s"});
  const auto end = run.ended();
  CHECK(end.code == transport);
  CHECK_THAT(end.output, Contains("structure (dummy_structure, pid ") &&
                             Contains("gave no answer for 0.5 s") && Contains("waited for it to join"));
}

TEST_CASE("a solver that stops answering is named as hanging after the timeout, be it stopped or busy") {
  const std::string how = GENERATE("stopped", "busy");
  Run run({.structure = how, .coupling = "timeout: 2 s, " + GENERATE(from_range(schemes))});
  const auto end = run.ended();
  CHECK(end.code == transport);
  CHECK_THAT(end.output, Contains("structure (dummy_structure, pid ") &&
                             Contains("gave no answer for 2 s (hangs; its process ") &&
                             Contains(how == "busy" ? "process runs" : "process is stopped") &&
                             Contains("in window 20"));
}

TEST_CASE("a solver that never introduces itself is named as hanging") {
  Run run({.particles = "asleep", .at = -1, .coupling = "timeout: 2 s"});
  const auto end = run.ended();
  CHECK(end.code == transport);
  CHECK_THAT(end.output,
             Contains("particles") && Contains("gave no answer for 2 s") && Contains("ask for its boundary"));
}

TEST_CASE("what a solver throws is said once, with its kind's exit code") {
  SECTION("any error") {
    Run run({.structure = "throws"});
    const auto end = run.ended();
    CHECK(end.code == transport);
    CHECK_THAT(end.output, Contains("gave up (the matrix is singular)") && Contains("in window 20"));
  }
  SECTION("a numerical error") {
    Run run({.structure = "numerical"});
    const auto end = run.ended();
    CHECK(end.code == numerical);
    CHECK_THAT(end.output, Contains("displacement is not finite at step 20, time 0.02 s: node 0"));
  }
  SECTION("a complaint about the scene, from both sides at once") {
    Run run({.structure = "refuses", .particles = "refuses", .at = -1});
    const auto end = run.ended();
    CHECK(end.code == config);
    CHECK_THAT(end.output, Contains("scene.yaml:3:1: structure: no such material"));
    CHECK(end.output.find("no such material") == end.output.rfind("no such material"));
  }
}

TEST_CASE("when the coupler is killed, its solvers say so and end, whatever they do") {
  const std::string how = GENERATE("none", "stopped", "busy");
  constexpr int window = 20;
  Run run({.structure = how,
           .at = window,
           .coupling = how == "none" ? "timeout: 600 s" : "timeout: 600 s, serial_implicit: {aitken: {}}"});
  run.wait_for_rows(window + 1);  // the row at the start of the window in which the structure misbehaves
  std::this_thread::sleep_for(100ms);
  run.program().signal(SIGKILL);
  CHECK(run.program().wait().code == -1);
  const auto deadline = std::chrono::steady_clock::now() + end_limit;
  for (const auto& child : run.children()) {
    while (test::exists(child.pid) && std::chrono::steady_clock::now() < deadline)
      std::this_thread::sleep_for(10ms);
    CHECK_FALSE(test::exists(child.pid));
  }
  CHECK_THAT(run.output(), Contains("the coupler (pid " + std::to_string(run.program().pid()) + ") died"));
  CHECK(segments_of(run.program().pid()).empty());
  CHECK_THAT(run.summary(), Contains("\"status\": \"running\""));
  CHECK(run.rows() >= 5);
}

TEST_CASE("Ctrl-C and SIGTERM end a run with everything written") {
  const int number = GENERATE(SIGINT, SIGTERM);
  Run run({});
  run.wait_for_rows();
  run.program().signal(number);
  const auto end = run.ended();
  CHECK(end.code == interrupted);
  CHECK_THAT(run.summary(), Contains("\"status\": \"interrupted\""));
}

TEST_CASE("Ctrl-C before the solvers have joined ends the run") {
  Run run({.structure = "asleep", .at = -2, .coupling = "join_timeout: 600 s"});
  std::this_thread::sleep_for(300ms);
  run.program().signal(SIGINT);
  CHECK(run.ended().code == interrupted);
}

TEST_CASE("a side that is started by hand takes part like one that talus starts") {
  Run run({.by_hand = "structure"});
  const test::TemporaryFolder folder;
  test::Program structure(run.command_by_hand(), folder.path() / "output.txt");
  run.wait_for_rows();
  run.program().signal(SIGINT);
  CHECK(run.ended().code == interrupted);
  CHECK(structure.wait().code == 0);
}

TEST_CASE("a side that nobody starts by hand is missed after the join timeout, and one that dies is named") {
  SECTION("nobody") {
    Run run({.coupling = "join_timeout: 0.5 s", .by_hand = "particles"});
    const auto end = run.ended();
    CHECK(end.code == transport);
    CHECK_THAT(end.output, Contains("particles") && Contains("gave no answer for 0.5 s"));
  }
  SECTION("killed") {
    Run run({.by_hand = "particles"});
    const test::TemporaryFolder folder;
    test::Program particles(run.command_by_hand(), folder.path() / "output.txt");
    run.wait_for_rows();
    particles.signal(SIGKILL);
    const auto end = run.ended();
    CHECK(end.code == transport);
    CHECK_THAT(end.output, Contains("particles (pid " + std::to_string(particles.pid()) + ") died"));
  }
}
