#pragma once

#include <signal.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <optional>
#include <regex>
#include <set>
#include <thread>

#include "tests/support/program.hpp"

/// Runs of `talus` on two solvers of which one misbehaves.
namespace talus::test {

using namespace std::chrono_literals;

/// A fault is noticed within a slice of 50 ms, or the scene's timeout, and everybody is gone within a grace
/// of 1 s. The rest is for a busy machine, on which programs take seconds to start: what is tested is that a
/// run ends at all.
inline constexpr auto end_limit = 60s;

/// Of one coupler, whose process id is in the name.
inline std::set<std::string> segments_of(int coupler) {
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
  std::string structure_program = TALUS_BINARY_DIR "/bin/dummy_structure";
};

class FaultyRun {
 public:
  explicit FaultyRun(const Faults& faults) {
    std::ofstream scene(folder_.path() / "scene.yaml");
    const auto side = [&](const char* name, const std::string& program, const std::string& behaviour) {
      scene << name << ": {solver: " << program << ", behaviour: " << behaviour << ", at: " << faults.at
            << "}\n";
    };
    scene << "time: {end: 60 s, step: 1 ms}\n";
    side("structure", faults.structure_program, faults.structure);
    side("particles", TALUS_BINARY_DIR "/bin/dummy_particles", faults.particles);
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
    const std::regex command("\n *(\\S+) (\\S+) --join (talus-\\S+)\n");
    std::smatch line;
    std::string text = output();  // outlives what is found in it
    const auto deadline = std::chrono::steady_clock::now() + end_limit;
    while (!std::regex_search(text, line, command)) {
      REQUIRE(std::chrono::steady_clock::now() < deadline);
      std::this_thread::sleep_for(5ms);
      text = output();
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
    children_ = children_of(program_->pid());
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
    const std::string text = text_of(folder_.path() / "result/probes.csv");
    return std::count(text.begin(), text.end(), '\n') - 1;
  }
  Program& program() { return *program_; }
  const std::vector<ChildProcess>& children() const { return children_; }
  std::string output() const { return text_of(folder_.path() / "output.txt"); }
  std::string summary() const { return text_of(folder_.path() / "result/summary.json"); }

  /// Waits for the end and checks what holds after every fault: nothing is left, and the result says that it
  /// failed.
  Ended ended() {
    const auto begin = std::chrono::steady_clock::now();
    const Ended end = program_->wait();
    CHECK(std::chrono::steady_clock::now() - begin < end_limit);
    CHECK(children_of(program_->pid()).empty());
    for (const auto& child : children_) CHECK_FALSE(exists(child.pid));
    CHECK(segments_of(program_->pid()).empty());
    return end;
  }

 private:
  Folder folder_{"faults"};
  std::optional<Program> program_;
  std::vector<ChildProcess> children_;
};

/// Faults must end runs of weak and of strong schemes alike.
inline const std::vector<std::string> schemes{"serial_explicit: {}", "serial_implicit: {aitken: {}}",
                                              "parallel_implicit: {iqn_ils: {}}"};

/// Exit codes.
inline constexpr int transport = 3, config = 2, numerical = 4, interrupted = 5;

}  // namespace talus::test
