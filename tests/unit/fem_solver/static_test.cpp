#include "fem_solver/integration/static_solver.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "tests/support/convergence.hpp"
#include "tests/support/structures.hpp"

namespace {

using namespace talus::fem;
namespace tests = talus::tests;

const AxialPart stiff_wire{.section = {.area = 1e-5, .youngs_modulus = 1e11, .prestress = 1e8},
                           .density = 7850};

struct Run {
  Run(Model built, const StaticOptions& options)
      : model(std::move(built)), assembly(model), solver(model, assembly, options) {}
  Model model;
  Assembly assembly;
  StaticSolver solver;
};

Model loaded_net() {
  Model model = tests::net<CableBatch>(stiff_wire, 0.1, 9);
  model.loads = {tests::load(40, {20, 0, -300})};
  return model;
}

}  // namespace

TEST_CASE("a static equilibrium leaves no residual in free directions, and its reactions balance the loads") {
  Run run(loaded_net(), {.end = 1, .step = 0.25});
  run.solver.advance(0, 1);
  std::vector<double> force(run.model.reference.size());
  run.assembly.internal_force(run.solver.displacement(), force);
  const double scale = run.assembly.largest_element_force();
  CHECK(std::abs(force[3 * 40 + 2] - 300) < 1e-9 * scale);
  CHECK(std::abs(force[3 * 39 + 2]) < 1e-9 * scale);
  Vector3 sum(20, 0, -300);
  const auto reactions = run.solver.reactions();
  for (std::size_t k = 0; k < reactions.size(); k += 3) sum += Vector3::Map(&reactions[k]);
  CHECK(sum.norm() < 1e-8 * scale);
}

TEST_CASE("Newton converges quadratically near a static equilibrium") {
  Run run(loaded_net(), {.end = 1, .step = 1, .newton = {.tolerance = 1e-13, .most_iterations = 60}});
  run.solver.advance(0, 1);
  const auto& residuals = run.solver.reports().back().residuals;
  WARN("relative residuals of a static step: " << tests::listed(residuals));
  CHECK(tests::converges_quadratically(residuals));
}

TEST_CASE("the work of growing loads becomes elastic energy") {
  // The trapezoidal rule over n load steps errs by 1/n^2 of the work.
  Run run(loaded_net(), {.end = 1, .step = 0.01});
  run.solver.advance(0, 1);
  const EnergyBalance balance = run.solver.balance();
  CHECK(balance.loads > 0);
  CHECK(balance.elastic[0] == Approx(balance.loads).epsilon(1e-3));
}

TEST_CASE("a cable net without prestress finds its shape under load though its flat tangent is singular") {
  AxialPart unstressed = stiff_wire;
  unstressed.section.prestress = 0;
  Model model = tests::net<CableBatch>(unstressed, 0.1, 5);
  model.gravity = Vector3(0, 0, -9.81);
  Run run(std::move(model), {.end = 1, .step = 1});
  run.solver.advance(0, 1);
  CHECK(run.solver.reports().front().shifted > 0);
  double weight = 0, held = 0;
  for (Index i = 0; i < run.model.nodes(); ++i) weight += 9.81 * run.model.node_masses[i];
  for (std::size_t k = 2; k < run.solver.reactions().size(); k += 3) held += run.solver.reactions()[k];
  CHECK(held == Approx(weight).epsilon(1e-9));
}

TEST_CASE("an unsupported mechanism is named with its nodes") {
  Model model = tests::chain<BarBatch>(
      {.section = {.area = 1e-4, .youngs_modulus = 1e9, .prestress = 0}, .density = 1}, 2, 2);
  model.supports = {tests::fixed({0, 2})};
  Run run(std::move(model),
          {.end = 1, .step = 1});  // two bars in line: the middle node moves across them freely
  try {
    run.solver.advance(0, 1);
    FAIL("no error");
  } catch (const talus::core::NumericalError& error) {
    CHECK_THAT(error.what(),
               Catch::Contains("unsupported mechanism") && Catch::Contains("node 1 of chain at (1, 0, 0) m"));
  }
}

TEST_CASE("prescribed motion stretches a bar as Hooke's law in Green-Lagrange strain says") {
  Model model = tests::chain<BarBatch>(
      {.section = {.area = 1e-4, .youngs_modulus = 1e9, .prestress = 0}, .density = 1}, 2, 1);
  model.supports = {tests::fixed({0}), tests::fixed({1})};
  model.supports[1].displacement = Vector3(0.1, 0, 0);
  Run run(std::move(model), {.end = 1, .step = 0.01});
  run.solver.advance(0, 1);
  const double l = 2.1, e = (l * l - 4) / 8, N = 1e-4 * 1e9 * e * l / 2;
  CHECK(run.solver.reactions()[3] == Approx(N).epsilon(1e-9));
  CHECK(run.solver.balance().supports == Approx(run.solver.balance().elastic[0]).epsilon(1e-3));
}
