#include "fem_solver/integration/implicit_solver.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "fem_solver/integration/explicit.hpp"
#include "tests/support/convergence.hpp"
#include "tests/support/structures.hpp"

namespace {

using namespace talus::fem;
namespace tests = talus::tests;

/// A film of 380 x 128 mm and 25 um, 24 x 8 cells, held at one long edge and led along at the other by 3 mm in 0.16 s.
Model sheared_panel() {
  constexpr Index columns = 24, rows = 8;
  Model model;
  const auto node = [](Index i, Index j) { return j * (columns + 1) + i; };
  Support low{.name = "low", .nodes = {}, .fixed = {true, true, true}, .history = {}}, high = low,
                                                                                       plane = low;
  high.displacement = Vector3(3e-3, 0, 0);
  high.history = {{{0, 0}, {0.16, 1}}};
  plane.fixed = {false, false, true};
  for (Index j = 0; j <= rows; ++j)
    for (Index i = 0; i <= columns; ++i) {
      model.reference.insert(model.reference.end(), {0.38 * i / columns, 0.128 * j / rows, 0.0});
      (j == 0 ? low : j == rows ? high : plane).nodes.push_back(node(i, j));
    }
  std::vector<std::array<Index, 3>> triangles;
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) {
      const Index a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if ((i + j) % 2 == 0)
        triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
      else
        triangles.insert(triangles.end(), {{a, b, d}, {b, c, d}});
    }
  const TensionField<ExactWrinkles> film(PlaneElasticity::from(IsotropicSheet{3.53e9, 0.31}), {0, 0, 0});
  model.parts.push_back(
      {"film", TensionFieldBatch({2.5e-5, 1420, Vector3::UnitX()}, film, triangles, model.reference), {}});
  model.supports = {low, high, plane};
  lump_masses(model);
  model.damping_rates.assign(model.node_masses.size(), 200);
  return model;
}

double total(const EnergyBalance& b) {
  double sum = b.kinetic + b.gravity + b.bulk_damping - b.loads - b.supports - b.interface;
  for (const double elastic : b.elastic) sum += elastic;
  return sum;
}

}  // namespace

TEST_CASE("the trapezoidal rule turns a linear oscillator by its own angle") {
  // Spectral radius 1: tan(phi/2) = w dt/2, amplitude kept, for any step.
  const Model model = tests::oscillator();
  const double w = std::sqrt(2e11 * 1e-4 / (7850 * 1e-4 / 2)), step = 3 / w, amplitude = 1e-7;
  Assembly assembly(model);
  ImplicitSolver solver(model, assembly,
                        {.step = step, .spectral_radius = 1, .newton = {.tolerance = 1e-14}});
  solver.state().displacement[3] = amplitude;
  const double phi = 2 * std::atan(0.5 * w * step);
  for (int n = 1; n < 30; ++n) {
    solver.advance((n - 1) * step, step);
    CHECK(solver.displacement()[3] == Approx(amplitude * std::cos(n * phi)).margin(1e-5 * amplitude));
  }
}

TEST_CASE("a spectral radius of 0 removes what the step cannot resolve, from the third step on") {
  const Model model = tests::oscillator();
  const double w = std::sqrt(2e11 * 1e-4 / (7850 * 1e-4 / 2)), step = 1e4 / w;
  Assembly assembly(model);
  ImplicitSolver solver(model, assembly,
                        {.step = step, .spectral_radius = 0, .newton = {.tolerance = 1e-14}});
  constexpr double amplitude =
      1e-11;  // m; the predictor goes 5e7 times as far, and must not turn the bar over
  solver.state().displacement[3] = amplitude;
  for (int n = 0; n < 6; ++n) {
    solver.advance(n * step, step);
    // All three roots of the step's amplification vanish as (w dt)^-2 = 1e-8; what they leave is 2e-8 at most.
    if (n >= 2) CHECK(std::abs(solver.displacement()[3]) < 1e-7 * amplitude);
  }
}

TEST_CASE("halving the implicit step divides its error by four") {
  const auto middle_after = [](int steps) {
    Model model = tests::net<CableBatch>(tests::wire, 0.1, 5);
    weigh(model, Vector3(0, 0, -9.81));
    tests::damp(model, {.mass = 10, .stiffness = 1e-5});
    Assembly assembly(model);
    const double length = 8e-3;
    ImplicitSolver solver(model, assembly,
                          {.step = length / steps, .spectral_radius = 0.8, .newton = {.tolerance = 1e-13}});
    solver.advance(0, length);
    return solver.displacement()[3 * 12 + 2];
  };
  const double coarse = middle_after(80), middle = middle_after(160), fine = middle_after(320);
  CHECK((coarse - middle) / (middle - fine) == Approx(4).epsilon(0.1));
}

TEST_CASE("Newton converges quadratically in an implicit step") {
  Model model = tests::net<CableBatch>(tests::wire, 0.1, 7);
  model.loads = {tests::load(24, {10, 0, -500})};
  Assembly assembly(model);
  const double step = 1e-3;  // 200 times the explicit limit: the net's forces count for more than its inertia
  ImplicitSolver solver(model, assembly, {.step = step, .newton = {.tolerance = 1e-13}});
  solver.advance(0, step);
  const auto& residuals = solver.reports().back().residuals;
  WARN("relative residuals of an implicit step: " << tests::listed(residuals));
  CHECK(tests::converges_quadratically(residuals));
  // One evaluation a residual, and more where the line search rejects a step.
  const bool one_each = solver.force_evaluations() == static_cast<std::int64_t>(residuals.size());
  CHECK(one_each == (solver.reports().back().cut == 0));
}

TEST_CASE("implicit and explicit integration agree on a net that falls into its prestress") {
  Model model = tests::net<CableBatch>(tests::wire, 0.1, 7);
  model.loads = {tests::load(24, {0, 0, -50})};
  model.damping_rates.assign(model.node_masses.size(), 20);
  const double length = 0.01;
  Assembly assembly(model);
  ExplicitSolver explicit_solver(model, assembly, 2e-6);
  explicit_solver.advance(0, length);
  ImplicitSolver implicit_solver(model, assembly,
                                 {.step = 2e-5, .spectral_radius = 1, .newton = {.tolerance = 1e-12}});
  implicit_solver.advance(0, length);
  CHECK(implicit_solver.displacement()[3 * 24 + 2] ==
        Approx(explicit_solver.displacement()[3 * 24 + 2]).epsilon(1e-3));
}

TEST_CASE("an implicit run closes its energy balance with loads, gravity, damping and moving supports") {
  Model model = tests::net<CableBatch>(tests::wire, 0.1, 7);
  tests::damp(model, {.mass = 40, .stiffness = 2e-6});
  weigh(model, Vector3(0, 1, -9.81));
  model.loads = {tests::load(24, {5, 0, -20})};
  model.supports[0].displacement = Vector3(0.01, 0, 0.02);
  model.supports[0].history.points = {{0, 0}, {0.005, 0}, {0.03, 1}};
  Assembly assembly(model);
  ImplicitSolver solver(model, assembly,
                        {.step = 1e-4, .spectral_radius = 1, .newton = {.tolerance = 1e-12}});
  const double start = total(solver.balance());
  double largest_kinetic = 0, worst = 0;
  EnergyBalance largest{};  // of each line
  for (int k = 0; k < 400; ++k) {
    solver.advance(k * 1e-4, 1e-4);
    const EnergyBalance balance = solver.balance();
    largest_kinetic = std::max(largest_kinetic, balance.kinetic);
    worst = std::max(worst, std::abs(total(balance) - start));
    for (const auto line : {&EnergyBalance::gravity, &EnergyBalance::bulk_damping, &EnergyBalance::loads,
                            &EnergyBalance::supports})
      largest.*line = std::max(largest.*line, std::abs(balance.*line));
  }
  // The trapezoidal rule of the works and that of the motion are the same: only the net's change of shape within
  // a step is missed, 2e-7 of the kinetic energy. So a line off by a ten-thousandth of itself is found.
  CHECK(worst < 1e-5 * largest_kinetic);
  for (const auto line : {&EnergyBalance::gravity, &EnergyBalance::bulk_damping, &EnergyBalance::loads,
                          &EnergyBalance::supports})
    CHECK(largest.*line > 0.1 * largest_kinetic);
}

namespace {

/// A mass on a bar along x, which an interface can push: node 1 of the oscillator.
struct PushedMass {
  Model model = tests::oscillator();
  double mass = 7850 * 1e-4 / 2, stiffness = 2e11 * 1e-4, step = 0;
  Assembly assembly{model};
  ImplicitSolver solver;
  PushedMass(double radius, double share_of_period)
      : step(share_of_period * 2 * M_PI / std::sqrt(stiffness / mass)),
        solver(model, assembly, {.step = step, .spectral_radius = radius, .newton = {.tolerance = 1e-14}}) {
    solver.interface() = InterfaceForce({1});
  }
  void push(double force, int window) {
    const std::array<double, 3> on_node{force, 0, 0};
    solver.interface().set(on_node);
    solver.advance(window * step, step);
  }
};

}  // namespace

TEST_CASE("a load that sets in acts whole in its first step") {
  // The trapezoidal rule under a constant force: u1 = (F h^2/2m)/(1 + k h^2/4m).
  PushedMass pushed(1, 0.1);
  constexpr double force = 1;  // N; small enough for the bar to be linear to 1e-7
  pushed.push(force, 0);
  const double h = pushed.step, m = pushed.mass, k = pushed.stiffness;
  CHECK(pushed.solver.displacement()[3] ==
        Approx(force * h * h / (2 * m) / (1 + k * h * h / (4 * m))).epsilon(1e-6));
}

TEST_CASE(
    "the work of interface forces is what the structure gains, whichever way they change from window to "
    "window") {
  PushedMass pushed(1, 0.1);
  double scale = 0;
  for (int window = 0; window < 40; ++window) {
    pushed.push(window % 3 == 0 ? 2.0 : window % 7 == 0 ? -5.0 : 1.0, window);
    const EnergyBalance balance = pushed.solver.balance();
    const double stored = balance.kinetic + balance.elastic[0];
    scale = std::max(scale, stored);
    // The bar is linear but for its strain, 1e-8: so is the trapezoidal rule exact for its energy.
    CHECK(stored == Approx(balance.interface).margin(1e-7 * scale));
  }
}

TEST_CASE("a constant interface force leads to its static answer whatever the spectral radius") {
  const double radius = GENERATE(0.0, 0.5, 0.9);
  PushedMass pushed(radius, 3);
  for (int window = 0; window < 400; ++window) pushed.push(1, window);
  CHECK(pushed.solver.displacement()[3] == Approx(1 / pushed.stiffness).epsilon(1e-4));
}

TEST_CASE("a sheet that wrinkles under shear gets no energy from nowhere, at any step and spectral radius",
          "[long]") {
  // Led by 1 mm in 20 ms: work of millijoules. At 50 us and radius 1 the trapezoidal rule alone makes kilojoules of them.
  const double radius = GENERATE(1.0, 0.9, 0.5, 0.0), step = GENERATE(200e-6, 50e-6, 20e-6);
  const Model model = sheared_panel();
  Assembly assembly(model);
  ImplicitSolver solver(model, assembly, {.step = step, .spectral_radius = radius});
  double worst = 0, supplied = 0;
  for (int n = 0; n < 20; ++n) {
    solver.advance(n * 1e-3, 1e-3);  // at 10 ms kilojoules are there where nothing is done about it
    const EnergyBalance balance = solver.balance();
    supplied = std::max(supplied, balance.supports);
    worst = std::max(worst, balance.kinetic + balance.elastic[0] + balance.bulk_damping - balance.supports);
  }
  INFO("radius " << radius << ", step " << step);
  CHECK(worst < 0.05 * supplied);
  CHECK(solver.balance().elastic[0] == Approx(supplied).epsilon(0.05));
}
