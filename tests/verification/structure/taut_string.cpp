#include <catch2/catch.hpp>

#include "fem_solver/integration/explicit.hpp"
#include "tests/support/structures.hpp"

using namespace talus::fem;
namespace tests = talus::tests;

TEST_CASE("a point load on a taut string settles where P = 2 N d/l with the element's own normal force") {
  // Two cables of length a and prestress force N0 under a load P across them: to leading order P = 2 N0 d/a +
  // EA (d/a)^3. With Green-Lagrange strain e = d^2/(2 a^2) the balance is exact: P = 2 (A/a)(E e + S) d,
  // which is the same two terms.
  const double a = 2, area = 1e-5, E = 1e11, S = 2e8, d = 0.05;
  const double P = 2 * area * S * d / a + E * area * std::pow(d / a, 3);
  Model model = tests::chain<CableBatch>(
      {.section = {.area = area, .youngs_modulus = E, .prestress = S}, .density = 7850}, 2 * a, 2);
  model.supports = {tests::fixed({0, 2})};
  model.loads = {tests::load(1, {0, 0, -P})};
  model.damping_rates.assign(model.node_masses.size(), 200);
  Assembly assembly(model);
  ExplicitSolver solver(model, assembly, 1e-4);
  const double step = 1e-4;
  for (int k = 0; k < 20000; ++k) solver.step(k * step, step);
  CHECK(solver.state().displacement[5] == Approx(-d).epsilon(1e-9));
}
