#include <catch2/catch.hpp>
#include <random>

#include "core/errors.hpp"
#include "core/output/checkpoint.hpp"
#include "coupler/acceleration/iqn_ils.hpp"
#include "coupler/acceleration/relaxation.hpp"
#include "coupler/run/checkpoints.hpp"
#include "coupler/schemes/implicit.hpp"
#include "coupler/schemes/parallel_explicit.hpp"
#include "coupler/schemes/serial_explicit.hpp"
#include "tests/support/coupled_pair.hpp"
#include "tests/support/program.hpp"
#include "tests/support/two_masses.hpp"

using namespace talus;
using namespace talus::coupler;

namespace {

using State = std::vector<double>;

/// What a solver does with the commands about its state.
void keep(const Command& command, State& state, State& saved) {
  if (command.action == Action::save_state) saved = state;
  if (command.action == Action::restore_state) state = saved;
  if (command.action == Action::write_checkpoint) {
    core::CheckpointWriter writer(command.path, "test");
    writer.values("state", state);
    writer.commit();
  }
  if (command.action == Action::read_checkpoint) {
    core::CheckpointReader reader(command.path, "test");
    reader.values("state", state);
  }
}

/// One node on three springs of different stiffness; its state is position and velocity.
void serve_node(Participant& participant) {
  participant.publish_surface(test::one_node(), std::array{2.0});
  participant.declare({.program = "node", .checkpoints = true});
  State state{0, 0, 0, 1, -2, 3}, saved;
  for (auto command = participant.next(); command.action != Action::finish; command = participant.next()) {
    const auto fields = participant.structure_fields();
    for (std::size_t i = 0; i < 3; ++i) {
      if (command.action != Action::advance) continue;
      const double stiffness = 100.0 * static_cast<double>(i + 1);
      state[3 + i] += command.length * (fields.force[i] - stiffness * state[i]) / 2;
      state[i] += command.length * state[3 + i];
    }
    keep(command, state, saved);
    std::copy_n(state.begin(), 3, fields.displacement.begin());
    std::copy_n(state.begin() + 3, 3, fields.velocity.begin());
    participant.answer();
  }
}

/// Hardening springs that wear out with the force they bore; their state is the wear.
void serve_springs(Participant& participant) {
  std::vector<double> masses;
  participant.receive_surface(masses);
  participant.declare({.program = "springs", .checkpoints = true});
  State wear(3), saved;
  for (auto command = participant.next(); command.action != Action::finish; command = participant.next()) {
    const auto fields = participant.particle_fields();
    for (std::size_t i = 0; i < 3; ++i) {
      if (command.action != Action::advance) continue;
      const double u = fields.end_displacement[i];
      fields.force[i] = -(400 * u + 9000 * u * u * u) / (1 + wear[i]);
      wear[i] += 1e-4 * std::abs(fields.force[i]);
    }
    keep(command, wear, saved);
    participant.answer();
  }
}

constexpr Span span{.end = 0.6, .window_length = 0.01};

Convergence loose() {
  return {.relative = 1e-6, .absolute = {1e-12, 1e-12, 1e-9}, .most_iterations = 50, .fail_otherwise = true};
}

/// The node's motion, window by window, from a checkpoint or from the start, with a checkpoint on the way.
template <class MakeScheme>
class Course {
 public:
  Course(MakeScheme make, const std::filesystem::path& folder) : make_(make), folder_(folder) {}

  std::vector<double> whole() { return run({}, -1); }
  void until(std::int64_t window) { run({}, window); }
  std::vector<double> after_restart() { return run(folder_ / "checkpoint.h5", -1); }

 private:
  std::vector<double> run(const std::filesystem::path& restart, std::int64_t checkpoint) {
    test::CoupledPair pair(serve_node, serve_springs, {span.window_length});
    auto scheme = make_(pair.exchange());
    const ArchiveOwnState archive = [&](core::StateArchive& state) {
      pair.exchange().archive(state);
      if constexpr (requires { scheme.archive(state); }) scheme.archive(state);
    };
    Checkpoints checkpoints(pair.session(), {.folder = folder_, .every = {}, .span = span}, archive);
    std::int64_t first = 0;
    if (!restart.empty()) {
      RestartPoint point(restart, span);
      point.restore(pair.session(), folder_, archive);
      first = point.window();
    }
    std::vector<double> path;
    for (std::int64_t n = first; n < span.windows(); ++n) {
      if (n == checkpoint) {
        checkpoints.write(n);
        break;
      }
      scheme.compute(pair.exchange(), span.window(n));
      const auto u = pair.exchange().structure().displacement;
      path.insert(path.end(), u.begin(), u.end());
      path.push_back(pair.exchange().work_on_structure());
      path.push_back(pair.exchange().work_on_boundary());
    }
    return path;
  }
  MakeScheme make_;
  std::filesystem::path folder_;
};

/// The end of the run in one piece, at random windows of a fixed seed.
template <class MakeScheme>
void check_restarts(MakeScheme make) {
  const test::Folder folder("split_run");
  Course course(make, folder.path());
  const std::vector<double> whole = course.whole();
  std::mt19937 random(7);
  for (int k = 0; k < 4; ++k) {
    course.until(std::uniform_int_distribution<std::int64_t>(1, span.windows() - 1)(random));
    const std::vector<double> rest = course.after_restart();
    INFO(rest.size() / 5 << " windows after the restart");
    REQUIRE(rest.size() < whole.size());
    CHECK(std::equal(rest.rbegin(), rest.rend(), whole.rbegin()));
  }
}

}  // namespace

TEST_CASE("a run split at a random window by checkpoint and restart has the bits of the run in one piece") {
  SECTION("serial explicit") {
    check_restarts([](Exchange&) { return SerialExplicit{}; });
  }
  SECTION("parallel explicit") {
    check_restarts([](Exchange&) { return ParallelExplicit{}; });
  }
  SECTION("serial implicit, Aitken, motion") {
    check_restarts([](Exchange& exchange) {
      return Implicit(MotionUnknown(exchange), Aitken(0.5), loose(), Predictor::linear);
    });
  }
  SECTION("serial implicit, Aitken, motion, in windows that are halved again and again") {
    Convergence few = loose();
    few.most_iterations = 3;
    few.most_halvings = 4;
    few.fail_otherwise = false;
    check_restarts([few](Exchange& exchange) {
      return Implicit(MotionUnknown(exchange), Aitken(0.5), few, Predictor::linear);
    });
  }
  SECTION("serial implicit, IQN-ILS, force") {
    check_restarts([](Exchange& exchange) {
      return Implicit(ForceUnknown(exchange), IqnIls({}), loose(), Predictor::linear);
    });
  }
  SECTION("parallel implicit, IQN-ILS, motion and force") {
    check_restarts([](Exchange& exchange) {
      return Implicit(MotionAndForceUnknown(exchange, 2.0), IqnIls({}), loose(), Predictor::linear);
    });
  }
}

TEST_CASE("a checkpoint of windows of another length, or of something else, is refused") {
  const test::Folder folder("split_run");
  Course course([](Exchange&) { return SerialExplicit{}; }, folder.path());
  course.until(5);
  const auto file = folder.path() / "checkpoint.h5";
  CHECK_THROWS_WITH(RestartPoint(file, Span{.end = 1, .window_length = 0.02}),
                    Catch::Contains("windows of 0.01 s, this scene has windows of 0.02 s"));
  CHECK_THROWS_AS(RestartPoint(folder.path() / "absent.h5", span), core::ConfigError);
  core::CheckpointWriter other(folder.path() / "other.h5", "fem_solver explicit");
  other.commit();
  CHECK_THROWS_WITH(RestartPoint(folder.path() / "other.h5", span),
                    Catch::Contains("is a checkpoint of 'fem_solver explicit', not of 'talus run'"));
}
