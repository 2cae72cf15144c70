#include <cstring>

#include "tests/faults/faulty_run.hpp"

using namespace talus;
using namespace talus::test;
using Catch::Matchers::Contains;

TEST_CASE(
    "a solver killed from outside is named with the window and what was waited for, and the other one ends") {
  const std::string victim = GENERATE("structure", "particles");
  FaultyRun run({.coupling = GENERATE(from_range(schemes))});
  run.wait_for_rows();
  kill(run.child(victim), SIGKILL);
  const auto end = run.ended();
  CHECK(end.code == transport);
  CHECK_THAT(end.output, Contains(victim + " (dummy_" + victim + ", pid ") &&
                             Contains("was killed by signal 9 (SIGKILL)") && Contains("in window "));
  CHECK_THAT(run.summary(), Contains("\"status\": \"failed\"") && Contains("SIGKILL"));
}

TEST_CASE("a solver that leaves in the middle of a run is named with its exit code") {
  FaultyRun run({.structure = "exit", .coupling = GENERATE(from_range(schemes))});
  const auto end = run.ended();
  CHECK(end.code == transport);
  CHECK_THAT(
      end.output,
      Contains("structure (dummy_structure, pid ") &&
          Contains(
              "ended with exit code 7 while the coupler waited for the answer to 'advance' in window 20"));
}

TEST_CASE("a solver that ends before it joins is named with its exit code") {
  FaultyRun run({.particles = "exit", .at = -2});
  const auto end = run.ended();
  CHECK(end.code == transport);
  CHECK_THAT(end.output, Contains("particles (dummy_particles, pid ") && Contains("ended with exit code 7"));
}

TEST_CASE("a solver that never joins is named after the join timeout and killed") {
  FaultyRun run({.structure = "asleep", .at = -2, .coupling = "join_timeout: 0.5 s"});
  const auto end = run.ended();
  CHECK(end.code == transport);
  CHECK_THAT(end.output, Contains("structure (dummy_structure, pid ") &&
                             Contains("gave no answer for 0.5 s") && Contains("waited for it to join"));
}

TEST_CASE("a solver that does not answer is named after the timeout, and whether it computes or is stuck") {
  const std::string how = GENERATE("stopped", "busy", "asleep");
  FaultyRun run({.structure = how, .coupling = "timeout: 2 s, " + GENERATE(from_range(schemes))});
  const auto end = run.ended();
  CHECK(end.code == transport);
  CHECK_THAT(end.output, Contains("structure (dummy_structure, pid ") &&
                             Contains("gave no answer for 2 s (") &&
                             Contains(how == "busy"     ? " s (computing, "
                                      : how == "asleep" ? " s (stuck: sleeps, "
                                                        : " s (is stopped)") &&
                             Contains("in window 20"));
}

TEST_CASE("a solver that never introduces itself is named as hanging") {
  FaultyRun run({.particles = "asleep", .at = -1, .coupling = "timeout: 2 s"});
  const auto end = run.ended();
  CHECK(end.code == transport);
  CHECK_THAT(end.output,
             Contains("particles") && Contains("gave no answer for 2 s") && Contains("ask for its boundary"));
}

TEST_CASE("what a solver throws is said once, with its kind's exit code") {
  SECTION("any error") {
    FaultyRun run({.structure = "throws"});
    const auto end = run.ended();
    CHECK(end.code == transport);
    CHECK_THAT(end.output, Contains("gave up (the matrix is singular)") && Contains("in window 20"));
  }
  SECTION("a numerical error") {
    FaultyRun run({.structure = "numerical"});
    const auto end = run.ended();
    CHECK(end.code == numerical);
    CHECK_THAT(end.output, Contains("displacement is not finite at step 20, time 0.02 s: node 0"));
  }
  SECTION("a complaint about the scene, from both sides at once") {
    FaultyRun run({.structure = "refuses", .particles = "refuses", .at = -1});
    const auto end = run.ended();
    CHECK(end.code == config);
    CHECK_THAT(end.output, Contains("scene.yaml:3:1: structure: no such material"));
    CHECK(end.output.find("no such material") == end.output.rfind("no such material"));
  }
}

TEST_CASE("when the coupler is killed, its solvers say so and end, whatever they do") {
  const std::string how = GENERATE("none", "stopped", "busy");
  constexpr int window = 20;
  FaultyRun run(
      {.structure = how,
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

TEST_CASE("a signal to the whole process group, once or twice, ends a run with everything written") {
  const int number = GENERATE(SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2);
  FaultyRun run({});
  run.wait_for_rows();
  run.program().signal(number);
  run.program().signal_group(number);
  const auto end = run.ended();
  const std::string name = std::string("SIG") + sigabbrev_np(number);
  CHECK(end.code == interrupted);
  CHECK_THAT(end.output, Contains(name + ": stops at the end of this window"));
  CHECK_THAT(run.summary(), Contains("\"status\": \"interrupted\"") && Contains("stopped by " + name));
}

TEST_CASE("what a solver's program has started ends with the run, after it was asked to") {
  test::Folder folder("wrapper");
  const auto file = [&](const char* name) { return (folder / name).string(); };
  // Like mpirun: a program that starts others and ends them when it is told to.
  folder.add("wrapper.sh",
             "#!/bin/sh\nsleep 600 &\necho $! > " + file("rank") + "\ntrap 'echo > " + file("asked") +
                 "; exit 1' TERM\n" TALUS_BINARY_DIR "/bin/dummy_structure \"$@\" &\nwait\nwait\n");
  std::filesystem::permissions(folder / "wrapper.sh", std::filesystem::perms::owner_all);
  FaultyRun run({.particles = "exit", .structure_program = file("wrapper.sh")});
  CHECK(run.ended().code == transport);
  CHECK(std::filesystem::exists(folder / "asked"));
  const int rank = std::stoi(text_of(folder / "rank"));
  const auto deadline = std::chrono::steady_clock::now() + end_limit;
  while (test::is_running(rank) && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(5ms);
  CHECK_FALSE(test::is_running(rank));
}

TEST_CASE("Ctrl-C before the solvers have joined ends the run") {
  FaultyRun run({.structure = "asleep", .at = -2, .coupling = "join_timeout: 600 s"});
  std::this_thread::sleep_for(300ms);
  run.program().signal(SIGINT);
  CHECK(run.ended().code == interrupted);
}

TEST_CASE("a side that is started by hand takes part like one that talus starts") {
  FaultyRun run({.by_hand = "structure"});
  const test::Folder folder("faults");
  test::Program structure(run.command_by_hand(), folder.path() / "output.txt");
  run.wait_for_rows();
  run.program().signal(SIGINT);
  CHECK(run.ended().code == interrupted);
  CHECK(structure.wait().code == 0);
}

TEST_CASE("a side that nobody starts by hand is missed after the join timeout, and one that dies is named") {
  SECTION("nobody") {
    FaultyRun run({.coupling = "join_timeout: 0.5 s", .by_hand = "particles"});
    const auto end = run.ended();
    CHECK(end.code == transport);
    CHECK_THAT(end.output, Contains("particles") && Contains("gave no answer for 0.5 s"));
  }
  SECTION("killed") {
    FaultyRun run({.by_hand = "particles"});
    const test::Folder folder("faults");
    test::Program particles(run.command_by_hand(), folder.path() / "output.txt");
    run.wait_for_rows();
    particles.signal(SIGKILL);
    const auto end = run.ended();
    CHECK(end.code == transport);
    CHECK_THAT(end.output, Contains("particles (pid " + std::to_string(particles.pid()) + ") died"));
  }
}
