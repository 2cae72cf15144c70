#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "core/errors.hpp"
#include "coupler/launch/find_solver.hpp"
#include "coupler/participant.hpp"
#include "coupler/schemes/serial_explicit.hpp"
#include "coupler/session/introduction.hpp"
#include "coupler/transport/segment.hpp"
#include "tests/support/program.hpp"

using namespace talus;
using coupler::Action;
using coupler::Role;

namespace {

const std::string root = TALUS_SOURCE_DIR;

coupler::Window window_of(std::int64_t index) {
  return {.index = index, .unit = 1e-3};
}

/// A structure in a program of its own, and particles that this test is itself.
class ForeignRun {
 public:
  ForeignRun(const std::string& solver, const std::vector<std::string>& arguments, double timeout = 20)
      : segment_(coupler::transport::create_shared_segment()), session_(segment_, {.timeout = timeout}) {
    auto program = coupler::launch::named_solver(solver, std::filesystem::path(root) / solver).value();
    program.command.insert(program.command.end(), arguments.begin(), arguments.end());
    session_.launch(Role::structure, program);
    session_.await(Role::particles);
    particles_ = coupler::Participant::join({.segment = segment_->name(), .role = Role::particles});
  }
  ~ForeignRun() {
    session_.abort("the test is over");
    if (pushing_.joinable()) pushing_.join();
  }

  /// Pushes node `node` down with `force(window)` N in each window.
  void start(std::size_t node, double (*force)(std::int64_t)) {
    pushing_ = std::thread([this, node, force] { push(node, force); });
    session_.wait_joined();
    interface_ = coupler::introduce(session_, coupler::identical_surfaces());
    coupler::lay_out_arrays(session_, interface_, {window_of(0).length()});
    exchange_.emplace(session_, interface_->tie.mapping);
  }
  void compute(std::int64_t window) { coupler::SerialExplicit{}.compute(*exchange_, window_of(window)); }
  coupler::Session& session() { return session_; }
  coupler::Peer& structure() { return *session_.find(Role::structure); }
  const coupler::Interface& interface() const { return *interface_; }

 private:
  void push(std::size_t node, double (*force)(std::int64_t)) try {
    const auto particles = std::move(particles_);  // leaves the run when this thread ends
    std::vector<double> masses;
    particles->receive_surface(masses);
    particles->declare({.program = "the test", .limits = {}, .effects = {}, .outputs = {}});
    for (auto command = particles->next(); command.action != Action::finish; command = particles->next()) {
      if (command.action == Action::advance) {
        particles->particle_fields().force[3 * node + 2] = force(command.window);
      }
      particles->answer();
    }
  } catch (const core::TransportError&) {
    // The run was ended, which the test sees on the coupler's side.
  }

  std::shared_ptr<coupler::transport::Segment> segment_;
  coupler::Session session_;
  std::unique_ptr<coupler::Participant> particles_;
  std::optional<coupler::Interface> interface_;
  std::optional<coupler::Exchange> exchange_;
  std::thread pushing_;
};

double pulsating_force(std::int64_t window) {
  return -50 * std::cos(0.01 * static_cast<double>(window));
}

double no_force(std::int64_t) {
  return 0;
}

/// The same solver in each language; Fortran where the machine has its compiler.
const std::vector<std::string> compiled_springs{
    TALUS_BINARY_DIR "/bin/springs_cpp",
    TALUS_BINARY_DIR "/bin/springs_c",
#ifdef TALUS_FORTRAN
    TALUS_BINARY_DIR "/bin/springs_f90",
#endif
};
const std::vector<std::string> springs = [] {
  auto all = compiled_springs;
  all.emplace_back("examples/participants/springs.py");
  return all;
}();

const std::string failing_in_python = "tests/coupled/participants/failing.py";
const std::string failing_in_c = TALUS_BINARY_DIR "/bin/failing_c";

void run_failing(const std::string& how, const std::string& program = failing_in_python) {
  ForeignRun run(program, {how});
  run.start(0, no_force);
  for (int window = 0; window < 5; ++window) run.compute(window);
}

/// s that the failure of a participant takes to be known, its Python's start not counted.
constexpr double noticed_within = 1;

}  // namespace

TEST_CASE("masses on springs in C, C++, Fortran and Python move as the leapfrog says, to the last bit") {
  const std::string program = GENERATE(from_range(springs));
  INFO(program);
  ForeignRun run(program, {"scene.yaml"});
  const std::size_t middle = 12, corner = 0;
  run.start(middle, pulsating_force);
  REQUIRE(run.interface().structure.node_count() == 25);
  REQUIRE(run.interface().structure.triangles.size() == 32);
  CHECK(run.interface().structure_masses == std::vector<double>(25, 10.0));

  const auto displacement = run.structure().array(coupler::transport::ArrayName::displacement);
  double position = 0, velocity = 0;
  for (int window = 0; window < 1000; ++window) {
    run.compute(window);
    velocity += 1e-3 * (pulsating_force(window) - 2e4 * position) / 10;
    position += 1e-3 * velocity;
    REQUIRE(displacement[3 * middle + 2] == position);
    REQUIRE(displacement[3 * corner + 2] == 0);
  }
  run.session().ask(run.structure(), {.action = Action::report, .window = 1000});
  CHECK(run.structure().output_arrays().probes(
            run.structure().array(coupler::transport::ArrayName::outputs))[0] == position);
  run.session().finish();
}

TEST_CASE("participants in C, C++, Fortran and Python go back to the state they saved") {
  const std::string program = GENERATE(from_range(springs));
  INFO(program);
  ForeignRun run(program, {"scene.yaml"});
  run.start(12, pulsating_force);
  const auto displacement = run.structure().array(coupler::transport::ArrayName::displacement);
  for (int window = 0; window < 10; ++window) run.compute(window);
  const double saved = displacement[3 * 12 + 2];
  run.session().ask(run.structure(), {.action = Action::save_state, .window = 10});
  for (int window = 10; window < 20; ++window) run.compute(window);
  CHECK(displacement[3 * 12 + 2] != saved);
  run.session().ask(run.structure(), {.action = Action::restore_state, .window = 10});
  CHECK(displacement[3 * 12 + 2] == saved);
  run.session().finish();
}

TEST_CASE("participants in C, C++, Fortran and Python go on from a checkpoint with the same bits") {
  const std::string program = GENERATE(from_range(springs));
  INFO(program);
  const test::Folder folder("foreign");
  const std::string file = folder.path() / "springs.part";
  constexpr int split = 40, end = 100;
  std::vector<double> expected;
  const auto copy_of = [](ForeignRun& run) {
    const auto u = run.structure().array(coupler::transport::ArrayName::displacement);
    return std::vector<double>(u.begin(), u.end());
  };
  {
    ForeignRun whole(program, {"scene.yaml"});
    whole.start(12, pulsating_force);
    REQUIRE(whole.structure().declaration().checkpoints);
    for (int window = 0; window < end; ++window) {
      if (window == split)
        whole.session().ask(whole.structure(),
                            {.action = Action::write_checkpoint, .window = split, .path = file});
      whole.compute(window);
    }
    expected = copy_of(whole);
    whole.session().finish();
  }
  ForeignRun rest(program, {"scene.yaml"});
  rest.start(12, pulsating_force);
  rest.session().ask(rest.structure(), {.action = Action::read_checkpoint, .window = split, .path = file});
  for (int window = split; window < end; ++window) rest.compute(window);
  CHECK(copy_of(rest) == expected);
  rest.session().finish();
}

TEST_CASE("a checkpoint of another state is refused by C, C++ and Fortran before it is taken") {
  const std::string program = GENERATE(from_range(compiled_springs));
  const test::Folder folder("foreign");
  const std::string file = folder.path() / "other.part";
  std::ofstream(file) << "too short";
  ForeignRun run(program, {"scene.yaml"});
  run.start(12, no_force);
  CHECK_THROWS(
      run.session().ask(run.structure(), {.action = Action::read_checkpoint, .window = 0, .path = file}));
}

TEST_CASE("a NumericalError of C or Python reaches the coupler with its step, time and entity") {
  const std::string program = GENERATE(failing_in_c, failing_in_python);
  INFO(program);
  try {
    run_failing("numerical", program);
    FAIL("the run went on");
  } catch (const core::NumericalError& error) {
    CHECK(error.details().what == "velocity is not finite");
    CHECK(error.details().entity == "node 0");
    CHECK(error.details().step == 2);
    CHECK(error.details().time == 0.002);
    CHECK(std::isinf(error.details().value));
  }
}

TEST_CASE("complaints of C or Python about the scene reach the coupler with their places") {
  const std::string program = GENERATE(failing_in_c, failing_in_python);
  INFO(program);
  try {
    run_failing("config", program);
    FAIL("the run went on");
  } catch (const core::ConfigError& error) {
    CHECK(error.complaints() ==
          std::vector<core::Complaint>{{.message = "scene.yaml: structure.solver: has no net"},
                                       {.file = "scene.yaml",
                                        .line = 7,
                                        .column = 3,
                                        .key_path = "structure.area",
                                        .message = "is missing"}});
  }
}

TEST_CASE("a machine that fails a program in C or Python is told apart from the program's own errors") {
  const std::string program = GENERATE(failing_in_c, failing_in_python);
  INFO(program);
  CHECK_THROWS_AS(run_failing("machine", program), core::MachineError);
  CHECK_THROWS_WITH(run_failing("machine", program), Catch::Contains("no room for the matrix"));
}

TEST_CASE("a reason that a program in C gives ends the run with the reason and the window") {
  using Catch::Contains;
  CHECK_THROWS_AS(run_failing("exception", failing_in_c), core::TransportError);
  CHECK_THROWS_WITH(run_failing("exception", failing_in_c),
                    Contains("a bug of the solver") && Contains("failing_c") && Contains("window 2"));
}

TEST_CASE("the text of a ConfigError raised in Python ends the run, and nothing else is said") {
  CHECK_THROWS_WITH(run_failing("config text"), "scene.yaml: structure.solver: has no net");
  CHECK_THROWS_AS(run_failing("config text"), core::ConfigError);
}

TEST_CASE("any other exception in Python ends the run with its type, its text and the window") {
  using Catch::Contains;
  CHECK_THROWS_WITH(run_failing("exception"), Contains("ZeroDivisionError: a bug of the solver") &&
                                                  Contains("failing.py") && Contains("window 2"));
  CHECK_THROWS_AS(run_failing("exception"), core::TransportError);
}

TEST_CASE("a Python participant that leaves or is killed is named within a second") {
  for (const auto& [how, told] :
       {std::pair{"leave", "SystemExit: 3"}, std::pair{"exit", "ended with exit code 7"},
        std::pair{"kill", "killed by signal 9"}}) {
    ForeignRun run("tests/coupled/participants/failing.py", {how});
    run.start(0, no_force);
    run.compute(0);
    run.compute(1);
    const auto before = std::chrono::steady_clock::now();
    CHECK_THROWS_WITH(run.compute(2), Catch::Contains(told) && Catch::Contains("window 2"));
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - before;
    CHECK(taken.count() < noticed_within);
  }
}

TEST_CASE("a Python participant that hangs is named after the timeout, and is gone with the run") {
  constexpr double timeout = 1;
  int pid = 0;
  {
    ForeignRun run("tests/coupled/participants/failing.py", {"hang"}, timeout);
    run.start(0, no_force);
    run.compute(0);
    run.compute(1);
    pid = static_cast<int>(run.structure().channel().pid);
    CHECK_THROWS_WITH(run.compute(2), Catch::Contains("gave no answer for 1 s (stuck: sleeps, ") &&
                                          Catch::Contains("window 2"));
  }
  CHECK_FALSE(test::exists(pid));
}
