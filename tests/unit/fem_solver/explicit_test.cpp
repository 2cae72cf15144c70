#include "fem_solver/integration/explicit.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "fem_solver/integration/step_limit.hpp"
#include "tests/support/structures.hpp"

namespace {

using namespace talus::fem;
namespace tests = talus::tests;

/// A half wave of velocity across the net. (Kicking single nodes instead puts most of the energy into the
/// shortest waves, where the trapezoidal work of a nonlinear force errs in proportion to (w dt)^2: there the
/// total wanders by 1 %, at half the step by 0.1 %.)
void push_as_by_a_wide_impact(const Model& model, ExplicitState& state, double speed) {
  const double side = model.position(model.nodes() - 1).x();
  for (Index node = 0; node < model.nodes(); ++node) {
    const Vector3 x = model.position(node) * std::numbers::pi / side;
    state.velocity[3 * node + 2] = speed * std::max(0.0, std::sin(x.x()) * std::sin(x.y()));
  }
}

double total(const EnergyBalance& b) {
  double sum = b.kinetic + b.gravity + b.bulk_damping - b.loads - b.supports - b.interface;
  for (const double elastic : b.elastic) sum += elastic;
  return sum;
}

struct Run {
  Run(Model built, double longest_step)
      : model(std::move(built)), assembly(model), solver(model, assembly, longest_step), step(longest_step) {}
  /// A run at a share of its own limit.
  static double limit(const Model& model) {
    Assembly assembly(model);
    return stable_step(largest_frequency(assembly, std::vector<double>(model.reference.size(), 0.0)),
                       largest_stiffness_damping(model));
  }
  void steps(int count) {
    for (int k = 0; k < count; ++k, time += step) solver.step(time, step);
  }
  Model model;
  Assembly assembly;
  ExplicitSolver solver;
  double step;
  double time = 0;
};

}  // namespace

TEST_CASE("a free oscillator keeps the leapfrog's own energy to round-off") {
  Run run(tests::oscillator(), 0.9 * Run::limit(tests::oscillator()));
  run.solver.state().velocity[3] =
      1e-6;  // small enough that the bar is linear to 1e-9; rounding and that add up slowly
  const double start = total(run.solver.balance());
  for (int k = 0; k < 1000; ++k) {
    run.steps(1);
    REQUIRE(total(run.solver.balance()) == Approx(start).epsilon(1e-7));
  }
}

TEST_CASE(
    "the first step's half kick starts a suddenly loaded oscillator on x = (F/k)(1 - cos w t) of the "
    "leapfrog") {
  // Central differences: x_n = (F/k)(1 - cos(n phi)) with 2 sin(phi/2) = w dt, from x_0 = 0 and x_1 = x_-1.
  const double k = 2e11 * 1e-4, m = 7850 * 1e-4 / 2, w = std::sqrt(k / m), step = 0.3 / w, F = 1e-2;
  Run run(tests::oscillator(), step);
  run.model.loads = {tests::load(1, {F, 0, 0})};
  const double phi = 2 * std::asin(0.5 * w * step);
  for (int n = 1; n < 50; ++n) {
    run.steps(1);
    CHECK(run.solver.state().displacement[3] == Approx(F / k * (1 - std::cos(n * phi))).margin(1e-8 * F / k));
  }
}

TEST_CASE(
    "an undamped elastic net at 0.9 of its limit keeps its energy within 0.1 % of the largest kinetic "
    "energy",
    "[long]") {
  Model model = tests::net<CableBatch>(tests::wire, 0.1, 9);
  const double limit = Run::limit(model);
  Run run(std::move(model), 0.9 * limit);
  push_as_by_a_wide_impact(run.model, run.solver.state(), 3);
  const double start = total(run.solver.balance());
  double largest_kinetic = 0, worst = 0;
  for (int k = 0; k < 1000; ++k) {
    run.steps(100);
    const EnergyBalance balance = run.solver.balance();
    largest_kinetic = std::max(largest_kinetic, balance.kinetic);
    worst = std::max(worst, std::abs(total(balance) - start));
  }
  CHECK(worst < 1e-3 * largest_kinetic);
}

TEST_CASE("damping, loads, gravity and moving supports close the energy balance") {
  Model model = tests::net<CableBatch>(tests::wire, 0.1, 7);
  tests::damp(model, {.mass = 40, .stiffness = 2e-6});
  weigh(model, Vector3(0, 1, -9.81));
  model.loads = {tests::load(24, {5, 0, -20})};
  model.loads[0].history.points = {{0, 0}, {0.01, 1}};
  model.supports[0].displacement = Vector3(0.01, 0, 0.02);
  model.supports[0].history.points = {{0, 0}, {0.005, 0}, {0.03, 1}};
  const double limit = Run::limit(model);
  Run run(std::move(model), 0.5 * limit);
  const double start = total(run.solver.balance());
  double largest_kinetic = 0, worst = 0, damped = 0;
  EnergyBalance largest{};  // of each line
  for (int k = 0; k < 100; ++k) {
    run.steps(20);
    const EnergyBalance balance = run.solver.balance();
    largest_kinetic = std::max(largest_kinetic, balance.kinetic);
    worst = std::max(worst, std::abs(total(balance) - start));
    CHECK(balance.bulk_damping >= damped);
    damped = balance.bulk_damping;
    for (const auto line : {&EnergyBalance::gravity, &EnergyBalance::loads, &EnergyBalance::supports})
      largest.*line = std::max(largest.*line, std::abs(balance.*line));
  }
  // Measured 1e-6: the trapezoidal work of the net's nonlinear forces. Stiffness damping, the smallest line, takes
  // a fortieth of the kinetic energy, so it is checked to a two-thousandth of itself.
  CHECK(worst < 1e-5 * largest_kinetic);
  CHECK(damped > 1.5 * largest_kinetic);
  for (const auto line : {&EnergyBalance::gravity, &EnergyBalance::loads, &EnergyBalance::supports})
    CHECK(largest.*line > 0.2 * largest_kinetic);
}

TEST_CASE("the balance of a braked oscillator closes from its first step on") {
  Model model = tests::oscillator();
  const double limit = Run::limit(model);
  tests::damp(model, {.mass = 0.2 / limit});
  Run run(std::move(model), 0.5 * limit);
  run.solver.state().velocity[3] = 1e-6;  // small enough that the bar is linear to 1e-9
  const double start = total(run.solver.balance());
  CHECK(start == Approx(run.solver.balance().kinetic).epsilon(1e-12));
  double damped = 0;
  for (int k = 0; k < 30; ++k) {
    run.steps(1);
    const EnergyBalance balance = run.solver.balance();
    CHECK(total(balance) == Approx(start).epsilon(1e-8));
    damped = balance.bulk_damping;
  }
  CHECK(damped > 0.5 * start);
}

TEST_CASE("a supported node follows its prescribed motion and its neighbours feel it") {
  Model model = tests::chain<BarBatch>(tests::steel, 1, 4);
  model.supports = {tests::fixed({0})};
  model.supports[0].displacement = Vector3(1e-3, 0, 0);
  model.supports[0].history.points = {{0, 0}, {1e-3, 1}};
  Run run(std::move(model), 2e-5);
  run.steps(50);
  CHECK(run.solver.state().displacement[0] == Approx(1e-3).epsilon(1e-12));
  // The same chain integrated apart from this program, in steps of 1 us; those of 20 us are off by a quarter of a
  // per cent.
  CHECK(run.solver.state().displacement[12] == Approx(0.83039e-3).epsilon(5e-3));
}

TEST_CASE("a reaction at rest is the weight it carries") {
  Model model = tests::chain<BarBatch>(tests::steel, 1, 4);
  model.supports = {tests::fixed({0})};
  weigh(model, Vector3(-9.81, 0, 0));
  model.damping_rates.assign(model.node_masses.size(), 5000);
  Run run(std::move(model), 2e-5);
  run.steps(20000);
  CHECK(run.solver.state().reactions[0] == Approx(1e-4 * 7850 * 9.81).epsilon(1e-6));
}

TEST_CASE("one, two and four threads give the same bits") {
  const auto run_with = [](int threads) {
    Model model = tests::net<CableBatch>(tests::wire, 0.1, 30);
    tests::damp(model, {.mass = 20, .stiffness = 1e-7});
    weigh(model, Vector3(0, 0, -9.81));
    talus::core::set_thread_count(threads);
    Run run(std::move(model), 1e-4);
    for (Index i = 0; i < 300; ++i) run.solver.state().velocity[900 + i] = std::sin(i);
    run.steps(100);
    talus::core::set_thread_count(1);
    return run.solver.state();
  };
  const ExplicitState one = run_with(1);
  CHECK(run_with(2) == one);
  CHECK(run_with(4) == one);
}

TEST_CASE("going back to a saved state repeats the run bit for bit") {
  Run run(tests::net<CableBatch>(tests::wire, 0.1, 9), 1e-4);
  run.solver.state().velocity[3 * 40 + 2] = 3;
  run.steps(10);
  const ExplicitState saved = run.solver.state();
  run.steps(10);
  const ExplicitState first = run.solver.state();
  run.solver.state() = saved;
  run.time = 10 * 1e-4;
  run.steps(10);
  CHECK(run.solver.state() == first);
}

TEST_CASE("asking for energies before the first step changes no bit of the state") {
  Model model = tests::net<CableBatch>(tests::wire, 0.1, 9);
  weigh(model, Vector3(0, 0, -9.81));
  Run run(std::move(model), 1e-4);
  const ExplicitState before = run.solver.state();
  CHECK(run.solver.balance().elastic.front() == Approx(0).margin(1e-12));
  CHECK(run.solver.state() == before);
}

TEST_CASE("a step that was prepared, in a state left and come back to, has the bits of one that was not") {
  const auto run_with = [](bool prepares) {
    Model model = tests::net<CableBatch>(tests::wire, 0.1, 9);
    tests::damp(model, {.mass = 20, .stiffness = 1e-7});
    weigh(model, Vector3(0, 0, -9.81));
    Run run(std::move(model), 1e-4);
    run.solver.state().velocity[3 * 40 + 2] = 3;
    for (int k = 0; k < 50; ++k) {
      if (prepares) {
        run.solver.prepare();
        run.solver.save();
        run.solver.advance(run.time, 1e-4);
        run.solver.prepare();
        run.solver.restore();
        run.solver.prepare();
      }
      run.steps(1);
    }
    return std::pair(run.solver.state(), run.solver.balance().elastic);
  };
  CHECK(run_with(true) == run_with(false));
}

TEST_CASE(
    "a prestressed net rests to the last bit until it is touched, then moves as if it had never waited") {
  constexpr Index middle = 40;
  constexpr double step = 1e-4, push = -25;  // s, N
  const auto run_after = [](int windows_of_rest) {
    Run run(tests::net<CableBatch>(tests::wire, 0.1, 9), step);
    run.solver.interface() = InterfaceForce({middle});
    const auto window = [&] {
      run.solver.advance(step * static_cast<double>(run.solver.state().steps), step);
    };
    for (int k = 0; k < windows_of_rest; ++k) window();
    CHECK(run.solver.state().displacement == std::vector<double>(3 * 81, 0.0));
    run.solver.interface().set(std::array{0.0, 0.0, push});
    window();
    // From rest one step of the leapfrog is dt^2 F/m.
    CHECK(run.solver.state().displacement[3 * middle + 2] ==
          Approx(step * step * push / run.model.node_masses[middle]));
    run.solver.interface().set(std::array{0.0, 0.0, 0.0});
    for (int k = 0; k < 50; ++k) window();
    return run.solver.state().displacement;
  };
  CHECK(run_after(200) == run_after(1));
}

TEST_CASE("a net whose forces do not cancel, whose load grows or whose rim moves does not rest") {
  Model model = tests::net<CableBatch>(tests::wire, 0.1, 9);
  SECTION("weight") {
    weigh(model, Vector3(0, 0, -9.81));
  }
  SECTION("a load that grows from zero") {
    model.loads = {tests::load(40, {0, 0, 1})};
    model.loads[0].history.points = {{0, 0}, {1, 1}};
  }
  SECTION("a rim that is led") {
    model.supports[0].displacement = Vector3(0, 0, 1);
    model.supports[0].history.points = {{0, 0}, {1, 1}};
  }
  SECTION("a velocity at the start") {
    model.initial_velocities = {{{40}, Vector3(0, 0, 1)}};
  }
  Run run(std::move(model), 1e-4);
  for (int k = 0; k < 20; ++k) run.solver.advance(1e-4 * k, 1e-4);
  CHECK(run.solver.state().displacement[3 * 40 + 2] != 0);
}

TEST_CASE("a step above the limit ends with an error that names a node and the last good output") {
  Run run(tests::net<CableBatch>(tests::wire, 0.1, 9), 1e-2);
  run.solver.state().velocity[3 * 40 + 2] = 3;
  run.solver.last_output_time = 0.125;
  try {
    run.steps(100000);
    FAIL("the run went on");
  } catch (const talus::core::NumericalError& error) {
    CHECK(error.details().step > 0);
    CHECK(error.details().last_output_time == 0.125);
    CHECK_THAT(error.details().entity, Catch::Contains("of net at ("));
  }
}

TEST_CASE("a rope with friction closes its energy balance where its segments pull each other to and fro") {
  // A taut rope of four straight stretches whose first bend is thrown aside: waves move material along the stretches,
  // where there is no friction. With the fall of elastic energy booked as friction the balance is off by two thirds of what it starts with.
  constexpr Index segments = 40, bend = 10;
  const std::array corners{Vector3(0, 0, 0), Vector3(3, 0, 0.2), Vector3(6, 0, 0), Vector3(9, 1, 0),
                           Vector3(12, 1, 0)};
  Model model;
  std::vector<std::array<Index, 2>> cells;
  for (Index i = 0; i <= segments; ++i) {
    const auto k = static_cast<std::size_t>(std::min(i, segments - 1) / bend);
    const Vector3 x =
        corners[k] + (i - bend * static_cast<Index>(k)) / double(bend) * (corners[k + 1] - corners[k]);
    model.reference.insert(model.reference.end(), x.begin(), x.end());
    if (i > 0) cells.push_back({i - 1, i});
  }
  const AxialPart rope{{.area = 1e-4, .youngs_modulus = 1e11, .prestress = 1e8}, 7850};
  model.parts.push_back({"rope", FrictionalCableBatch({rope, {0.2}}, cells, model.reference), {}});
  model.supports = {tests::fixed({0, segments})};
  model.initial_velocities = {{{bend}, Vector3(0, 0, 20)}};
  lump_masses(model);
  Assembly assembly(model);
  ExplicitSolver solver(model, assembly, 20e-6);
  const double start = 0.5 * model.node_masses[bend] * 400;
  double worst = 0, slipped = 0;
  for (int n = 0; n < 50; ++n) {
    solver.advance(n * 100e-6, 100e-6);
    const EnergyBalance b = solver.balance();
    worst = std::max(worst, std::abs(b.kinetic + b.elastic[0] + b.dissipated[0] - start));
    slipped = b.dissipated[0];
  }
  CHECK(slipped > 1e-4 * start);
  CHECK(worst < 0.01 * start);
}
