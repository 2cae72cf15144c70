// The reference values were computed independently of this program: the same three-node bar in Green-Lagrange strain,
// N = A E (e + beta de/dt) l/L, by Runge-Kutta's method of fourth order at 1 us, where they no longer change with the
// step. (Damping by the whole tangent gives 2e-4 less at 0.45 ms.)
#include <catch2/catch.hpp>

#include "fem_solver/integration/explicit.hpp"
#include "tests/support/structures.hpp"

using namespace talus::fem;
namespace tests = talus::tests;

TEST_CASE("a suddenly loaded, damped bar moves as computed independently") {
  const AxialPart steel{.section = {.area = 0.01, .youngs_modulus = 2.1e11, .prestress = 0}, .density = 7850};
  Model model = tests::chain<BarBatch>(steel, 1, 2);
  model.supports = {tests::fixed({0}), tests::fixed({1, 2}, {false, true, true})};
  model.loads = {tests::load(2, {1e7, 0, 0})};
  tests::damp(model, {.mass = 471.88, .stiffness = 5.1e-6});
  Assembly assembly(model);
  ExplicitSolver solver(model, assembly, 1e-8);

  const double step = 1e-8;
  const std::vector<std::pair<double, double>> reference = {
      {3e-4, 6.7927151e-3}, {4.5e-4, 8.1091083e-3}, {1.2e-3, 7.3089072e-3}};
  int steps = 0;
  for (const auto& [time, end_displacement] : reference) {
    for (; steps < std::lround(time / step); ++steps) solver.step(steps * step, step);
    CHECK(solver.state().displacement[6] == Approx(end_displacement).epsilon(1e-5));
  }
}
