#include "fem_solver/integration/step_limit.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "core/errors.hpp"
#include "fem_solver/integration/explicit.hpp"
#include "fem_solver/integration/frequency_bound.hpp"
#include "fem_solver/integration/mass_scaling.hpp"
#include "tests/support/structures.hpp"

namespace {

using namespace talus::fem;
namespace tests = talus::tests;

const AxialPart bar{.section = {.area = 1e-4, .youngs_modulus = 2e11, .prestress = 0}, .density = 8000};
const AxialPart string{.section = {.area = 1e-4, .youngs_modulus = 1e3, .prestress = 1e9}, .density = 8000};

double frequency_at_rest(const Model& model) {
  Assembly assembly(model);
  return largest_frequency(assembly, std::vector<double>(model.reference.size(), 0.0));
}

}  // namespace

TEST_CASE("the largest frequency of a free chain of bars is 2 c/h, with c = sqrt(E/rho)") {
  Model model = tests::chain<BarBatch>(bar, 2, 16);
  CHECK(frequency_at_rest(model) == Approx(2 * std::sqrt(2e11 / 8000) / (2.0 / 16)).epsilon(1e-6));
}

TEST_CASE("a prestressed wire with little EA is a string: the limit follows sqrt(S/rho)") {
  // Fixed ends, n divisions: w = (2 c/h) sin((n - 1) pi/(2 n)); the string's transverse waves, and along it E
  // + S.
  Model model = tests::chain<CableBatch>(string, 2, 16);
  model.supports = {tests::fixed({0, 16})};
  const double c = std::sqrt((1e3 + 1e9) / 8000);
  CHECK(frequency_at_rest(model) ==
        Approx(2 * c / (2.0 / 16) * std::sin(15 * std::numbers::pi / 32)).epsilon(1e-6));
}

TEST_CASE("a slack cable limits the step as if it were taut, because it may become so") {
  AxialPart slack = bar;
  slack.section.prestress = -1;
  CHECK(frequency_at_rest(tests::chain<CableBatch>(slack, 2, 16)) ==
        Approx(2 * std::sqrt(2e11 / 8000) / (2.0 / 16)).epsilon(1e-6));
}

TEST_CASE("a slider held by a spring limits the step as it does where it passes a rope node") {
  // A soft rope, so that the spring alone counts: w^2 = alpha (1/m_slider + 1/m_node), wherever it stands
  // now.
  constexpr double alpha = 1e6, slider_mass = 0.3, softness = 1e-6;
  Model model = tests::chain<BarBatch>({.section = {1e-4, softness, 0}, .density = 8000}, 2, 4);
  model.reference.insert(model.reference.end(), {0.8, 0, 0});  // between nodes 1 and 2
  model.parts.push_back({"slide", PenaltySlideBatch({{0, 1, 2, 3, 4}, {5}}, alpha, model.reference), {}});
  lump_masses(model);
  model.node_masses[5] = slider_mass;
  const double expected = std::sqrt(alpha * (1 / slider_mass + 1 / model.node_masses[2]));
  CHECK(frequency_at_rest(model) == Approx(expected).epsilon(1e-6));
}

TEST_CASE(
    "bounds of stiffness bound the highest frequency of a net at random states and give that of a chain") {
  const double chain = frequency_at_rest(tests::chain<BarBatch>(bar, 2, 16));
  CHECK(frequency_bound(tests::chain<BarBatch>(bar, 2, 16), std::vector<double>(51, 0.0)).squared ==
        Approx(chain * chain).epsilon(1e-6));
  Model net = tests::net<BarBatch>(bar, 0.1, 7);
  Assembly assembly(net);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> move(-0.03, 0.03);  // of 0.1 m: strains of tens of percent
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> displacement(net.reference.size());
    for (double& u : displacement) u = move(random);
    const double w = largest_frequency(assembly, displacement);
    const double bound = frequency_bound(net, displacement).squared;
    CHECK(bound > 0.99 * w * w);  // w has its residual added
    CHECK(bound < 4 * w * w);
  }
}

TEST_CASE("bounds of stiffness give the highest frequency of a square net along its axes") {
  // Of an endless net: w^2 = 4 k/m with m of four half cables; at the rim a node has more mass for its cables.
  const double w = frequency_at_rest(tests::net<BarBatch>(bar, 0.1, 12));
  const Model net = tests::net<BarBatch>(bar, 0.1, 12);
  CHECK(frequency_bound(net, std::vector<double>(net.reference.size(), 0.0)).squared < 1.1 * w * w);
}

TEST_CASE("bounds of stiffness hold for every kind of part, slack or taut, bent or straight") {
  // Along and up a frame of five nodes; w of everything taut that can be, as the step limit has it.
  const std::vector<double> nodes{0, 0, 0, 1, 0.1, 0, 2, 0, 0.2, 3, 0.3, 0, 4, 0, 0};
  const std::vector<std::array<Index, 2>> line{{0, 1}, {1, 2}, {2, 3}, {3, 4}};
  const AxialPart rope{.section = {1e-4, 1e9, 1e6}, .density = 7850};
  const ElasticRope elastic{rope.section};
  const std::vector<ElementBatch> kinds{
      CableBatch(rope, line, nodes),
      SlidingCableBatch(rope, 0, line, nodes),
      FrictionalCableBatch({rope, {0.1}, 0}, line, nodes),
      ElasticPlasticBatch({{rope.section, 5e7, 1e8}, 0.785}, line, nodes),
      BrakeBatch({BrakeLaw({{{0.02, 40e3}, {0.5, 60e3}}, 5e6, 0.05}), 1}, line, nodes),
      BreakingCableBatch({{elastic, {.force = 1e9}}, 0.785}, line, nodes),
      BreakingRopeBatch(SlidingCableBatch(rope, 0, line, nodes), {.force = 1e9}),
      PlainRingBatch({RingLaw({2.5, 100}, {3, 1000}), 1, 1}, {{0, 1}, {1, 0}, {1, 2}, {2, 1}}, nodes),
      TensionFieldBatch({0.01, 1000, Vector3(1, 0, 0)},
                        TensionField<ExactWrinkles>(PlaneElasticity::from(IsotropicSheet{1e8, 0.3}), {}),
                        {{0, 1, 2}, {2, 3, 4}}, nodes)};
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> move(-0.2, 0.2);
  for (const ElementBatch& kind : kinds) {
    Model model;
    model.reference = nodes;
    model.parts.push_back({"part", kind, {}});
    lump_masses(model);
    Assembly assembly(model);
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<double> displacement(nodes.size());
      for (double& u : displacement) u = move(random);
      const double w = largest_frequency(assembly, displacement);
      CAPTURE(kind.index(), trial);
      CHECK(frequency_bound(model, displacement).squared > 0.99 * w * w);  // w has its residual added
    }
  }
}

TEST_CASE(
    "a run that stretches a rope ends where its step becomes unstable, and says what the limit fell to") {
  // The rope's end is led away slowly: e = ((1 + x/2)^2 - 1)/2, stiffness 1 + 3 e times that at the start.
  const auto stretch_reached = [](double share_of_limit) {
    Model model = tests::chain<BarBatch>(bar, 2, 4);
    model.supports = {tests::fixed({0}), tests::fixed({4})};
    model.supports[1].displacement = Vector3(1, 0, 0);
    model.supports[1].history = {{{0.0, 0.0}, {1.0, 1.0}}};
    Assembly assembly(model);
    const double step =
        share_of_limit * stable_step(frequency_at_rest(model), largest_stiffness_damping(model));
    ExplicitSolver solver(model, assembly, step);
    solver.watch_step();
    try {
      for (double time = 0; time < 0.5; time += step) solver.step(time, step);
    } catch (const talus::core::NumericalError& error) {
      CHECK_THAT(error.what(), Catch::Contains("above the limit of stability, which fell to") &&
                                   Catch::Contains("node") && Catch::Contains("of chain at"));
      CHECK(error.details().value < step);
      return solver.displacement()[12];
    }
    return 1.0;
  };
  const double e = (1 / 0.81 - 1) / 3, expected = 2 * (std::sqrt(1 + 2 * e) - 1);
  CHECK(stretch_reached(0.9) == Approx(expected).epsilon(0.05));  // waves of the pull run through the rope
  CHECK(stretch_reached(0.5) == 1.0);
}

TEST_CASE(
    "mass scaling makes the step that it is asked for stable and adds nothing where that is stable anyway") {
  for (const double damping : {0.0, 1e-4}) {
    Model model = tests::net<CableBatch>(string, 0.1, 9);
    damp_by_stiffness(model, damping);
    const double mass = std::accumulate(model.node_masses.begin(), model.node_masses.end(), 0.0);
    const double limit = stable_step(frequency_at_rest(model), largest_stiffness_damping(model));
    CHECK(scale_masses(model, 0.5 * limit).nodes == 0);
    const AddedMass added = scale_masses(model, 3 * limit);
    CHECK(added.nodes == 49);  // all that are free
    CHECK(std::accumulate(model.node_masses.begin(), model.node_masses.end(), 0.0) ==
          Approx(mass + added.kilograms));
    CHECK(added.share == Approx(added.kilograms / mass));
    CHECK(stable_step(frequency_at_rest(model), largest_stiffness_damping(model)) > 3 * limit * (1 - 1e-9));
  }
}

TEST_CASE("a free oscillator is stable just below the limit and blows up just above it") {
  for (const double stiffness_damping : {0.0, 1e-5, 1e-3}) {
    for (const double mass_damping : {0.0, 300.0}) {
      Model model = tests::chain<BarBatch>(bar, 1, 1);
      model.supports = {tests::fixed({0}), tests::fixed({1}, {false, true, true})};
      tests::damp(model, {.mass = mass_damping, .stiffness = stiffness_damping});
      const double limit = stable_step(frequency_at_rest(model), largest_stiffness_damping(model));
      const auto largest_after = [&](double step) {
        Assembly assembly(model);
        ExplicitSolver solver(model, assembly, step);
        solver.state().velocity[3] = 1e-12;
        for (int k = 0; k < 2000; ++k) solver.step(k * step, step);
        return std::abs(solver.state().velocity[3]);
      };
      CHECK(largest_after(0.99 * limit) < 1e-11);
      CHECK(largest_after(1.01 * limit) > 1e-9);
    }
  }
}

TEST_CASE("stretching a bar by a fifth raises its own limit frequency squared by 1 + 3 e") {
  Model model = tests::chain<BarBatch>(bar, 1, 1);
  model.supports = {tests::fixed({0}), tests::fixed({1}, {false, true, true})};
  Assembly assembly(model);
  const double e = 0.2, elongation = std::sqrt(1 + 2 * e) - 1;
  const std::vector<double> displacement{0, 0, 0, elongation, 0, 0};
  const double ratio = largest_frequency(assembly, displacement) / frequency_at_rest(model);
  CHECK(ratio * ratio == Approx(1 + 3 * e).epsilon(1e-9));
}

TEST_CASE("the bounds are those of the structure, of each part alone, and of its tension alone") {
  // Rope nodes at both ends of a slider's spring; ropes of 16 divisions between fixed ends.
  constexpr double alpha = 1e6, slider_mass = 0.3;
  Model model = tests::chain<CableBatch>(string, 2, 16);
  model.supports = {tests::fixed({0, 16})};
  std::vector<Index> rope(17);
  std::iota(rope.begin(), rope.end(), 0);
  model.reference.insert(model.reference.end(), {0.8, 0, 0});
  model.parts.push_back({"slide", PenaltySlideBatch({rope, {17}}, alpha, model.reference), {}});
  lump_masses(model);
  model.node_masses[17] = slider_mass;
  Assembly assembly(model);
  const auto bounds = step_bounds(assembly, std::vector<double>(model.reference.size(), 0.0));
  const auto seconds_of = [&](const std::string& name) {
    const auto found = std::ranges::find(bounds, name, &StepBound::name);
    REQUIRE(found != bounds.end());
    return found->seconds;
  };
  REQUIRE(bounds.size() == 4);
  CHECK(bounds[0].name == "highest frequency of the structure");
  const double h = 2.0 / 16, shortest_wave = std::sin(15 * std::numbers::pi / 32);
  CHECK(seconds_of("cables of chain alone") ==
        Approx(h / (std::sqrt((1e3 + 1e9) / 8000) * shortest_wave)).epsilon(1e-6));
  CHECK(seconds_of("geometric stiffness of chain alone") ==
        Approx(h / (std::sqrt(1e9 / 8000) * shortest_wave)).epsilon(1e-6));
  CHECK(seconds_of("penalty springs of slide alone") ==
        Approx(2 / std::sqrt(alpha * (1 / slider_mass + 1 / model.node_masses[2]))).epsilon(1e-6));
  for (const auto& bound : bounds) CHECK(bound.seconds >= bounds[0].seconds);
}

TEST_CASE(
    "the limit names the part that takes most of the fastest mode, not the one that a wave passes soonest") {
  // A post of 1 m, which a wave passes in a fifth of a millisecond, between heavy nodes; beside it a rope of 16 divisions, which a wave
  // passes more slowly, one each 0.35 ms, but whose nodes are light.
  Model model = tests::chain<CableBatch>(string, 2, 16);
  model.supports = {tests::fixed({0, 16})};
  model.reference.insert(model.reference.end(), {5, 0, 0, 6, 0, 0});
  model.parts.push_back({"post", BarBatch(bar, {{17, 18}}, model.reference), {}});
  lump_masses(model);
  model.node_masses[17] = model.node_masses[18] = 1e5;
  Assembly assembly(model);
  const auto bounds = step_bounds(assembly, std::vector<double>(model.reference.size(), 0.0));
  REQUIRE_THAT(bounds[0].reason, Catch::Contains("set by the cables of chain, most of all at node"));
  CHECK_THAT(bounds[0].reason, !Catch::Contains("post"));
}

TEST_CASE("the node that the limit names is the one where the structure is stiffest for its mass") {
  Model model = tests::chain<BarBatch>(bar, 2, 16);
  model.node_masses[5] *= 1e-3;
  Assembly assembly(model);
  const auto bounds = step_bounds(assembly, std::vector<double>(model.reference.size(), 0.0));
  CHECK_THAT(bounds[0].reason, Catch::Contains("most of all at node 5 "));
}

TEST_CASE("only where a rope hangs slack the limit says that snapping taut wants a quarter of it") {
  const auto reason_with = [](double prestress) {
    AxialPart rope = string;
    rope.section.prestress = prestress;
    const Model model = tests::chain<CableBatch>(rope, 2, 16);
    Assembly assembly(model);
    return step_bounds(assembly, std::vector<double>(model.reference.size(), 0.0))[0].reason;
  };
  CHECK_THAT(reason_with(0), Catch::Contains("take a quarter of it"));
  CHECK_THAT(reason_with(1e6), !Catch::Contains("quarter"));
}
