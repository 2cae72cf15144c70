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

/// Largest force that is left in a free direction (N), by the model's own loads and weights at full size.
double left_over(const Run& run) {
  std::vector<double> force(run.model.reference.size());
  Assembly(run.model).internal_force(run.solver.displacement(), force);
  for (const auto& load : run.model.loads)
    for (const Index node : load.nodes) Vector3::Map(&force[3 * node]) += load.force;
  for (std::size_t i = 0; i < run.model.weight.size(); ++i) force[i] += run.model.weight[i];
  for (const auto& support : run.model.supports)
    for (const Index node : support.nodes)
      for (int c = 0; c < 3; ++c)
        if (support.fixed[c]) force[3 * node + c] = 0;
  return Eigen::VectorXd::Map(force.data(), static_cast<Eigen::Index>(force.size()))
      .lpNorm<Eigen::Infinity>();
}

Model loaded_net() {
  Model model = tests::net<CableBatch>(stiff_wire, 0.1, 9);
  model.loads = {tests::load(40, {20, 0, -300})};
  return model;
}

}  // namespace

TEST_CASE("a static equilibrium leaves no residual in free directions, and its reactions balance the loads") {
  Run run(loaded_net(), {.end = 1, .step = 0.25});
  run.solver.advance(0, 1);
  const double scale = run.assembly.largest_element_force();
  CHECK(scale > 1000);  // N; 1e8 Pa of prestress on 1e-5 m^2 alone
  CHECK(left_over(run) < 1e-9 * scale);
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

TEST_CASE("squares count as quadratic convergence, a linear rate does not, however small") {
  CHECK(tests::converges_quadratically({3e-1, 2e-2, 9e-5, 2e-9, 1e-15}));
  CHECK(tests::converges_quadratically({1e-2, 7e-3, 2e-2, 1e-5, 3e-9, 1e-16}));  // astray before it is near
  for (const double rate : {0.5, 0.04, 1e-3}) {
    std::vector<double> residuals{9e-3};
    while (residuals.back() > 1e-13) residuals.push_back(rate * residuals.back());
    CHECK_FALSE(tests::converges_quadratically(residuals));
  }
  CHECK_FALSE(tests::converges_quadratically({1, 1e-9, 1e-14}));  // too few to tell
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
  weigh(model, Vector3(0, 0, -9.81));
  Run run(std::move(model), {.end = 1, .step = 1});
  run.solver.advance(0, 1);
  CHECK(run.solver.reports().front().shifted > 0);
  CHECK(left_over(run) < 1e-9 * run.assembly.largest_element_force());
  CHECK(run.solver.displacement()[3 * 12 + 2] < -1e-4);  // its middle hangs
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
