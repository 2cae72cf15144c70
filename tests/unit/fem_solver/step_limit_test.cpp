#include "fem_solver/integration/step_limit.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "fem_solver/integration/explicit.hpp"
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

TEST_CASE("a free oscillator is stable just below the limit and blows up just above it") {
  for (const double stiffness_damping : {0.0, 1e-5, 1e-3}) {
    for (const double mass_damping : {0.0, 300.0}) {
      Model model = tests::chain<BarBatch>(bar, 1, 1);
      model.supports = {tests::fixed({0}), tests::fixed({1}, {false, true, true})};
      model.damping = {.mass = mass_damping, .stiffness = stiffness_damping};
      const double limit = stable_step(frequency_at_rest(model), model.damping);
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

TEST_CASE("the bounds name waves along and across each part and put the whole structure first") {
  Model model = tests::chain<CableBatch>(string, 2, 16);
  Assembly assembly(model);
  const auto bounds = step_bounds(assembly, std::vector<double>(model.reference.size(), 0.0));
  REQUIRE(bounds.size() == 3);
  CHECK(bounds[0].name == "highest frequency of the structure");
  CHECK(bounds[1].name == "wave along chain");
  CHECK(bounds[1].seconds == Approx(2.0 / 16 * std::sqrt(8000 / (1e3 + 1e9))));
  CHECK(bounds[2].name == "string wave across chain");
  CHECK(bounds[2].seconds == Approx(2.0 / 16 * std::sqrt(8000 / 1e9)));
}
