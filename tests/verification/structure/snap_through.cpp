#include <catch2/catch.hpp>
#include <cmath>

#include "fem_solver/integration/static_solver.hpp"
#include "tests/support/structures.hpp"

using namespace talus::fem;
namespace tests = talus::tests;

namespace {

constexpr double E = 2.1e11, A = 0.01, S_pre = 1e5;

/// The load that holds a shallow bar from (0, 0) to (2, 1) whose top has come down to height y: total
/// Lagrangian, L^2 = 5.
double load_at(double y) {
  return -(E * (y * y - 1) / 10 + S_pre) * A * y / std::sqrt(5.0);
}

/// Height at which the load is P on the branch between `low` and `high`, by bisection.
double height_at(double P, double low, double high) {
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    ((load_at(low) - P) * (load_at(middle) - P) <= 0 ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// Vertical displacement of the top under a vertical load that grows to `P` in `steps` steps.
double top_displacement(double P, double steps) {
  Model model;
  model.reference = {0, 0, 0, 2, 1, 0};
  tests::add_part<BarBatch>(
      model, "bar", {.section = {.area = A, .youngs_modulus = E, .prestress = S_pre}, .density = 7850},
      {{0, 1}});
  model.supports = {tests::fixed({0}), tests::fixed({1}, {true, false, true})};
  model.loads = {tests::load(1, {0, -P, 0})};
  Assembly assembly(model);
  StaticSolver solver(model, assembly, {.end = 1, .step = 1 / steps});
  solver.advance(0, 1);
  return solver.displacement()[4];
}

}  // namespace

TEST_CASE("the shallow bar follows its closed form before the limit point") {
  CHECK(top_displacement(3.7e5, 1) == Approx(height_at(3.7e5, 0.6, 1.1) - 1).epsilon(1e-10));
  CHECK(top_displacement(3.7e5, 1) == Approx(-0.0019781111669255527).epsilon(1e-10));
  CHECK(top_displacement(3.5e7, 50) == Approx(height_at(3.5e7, 0.578, 1.1) - 1).epsilon(1e-9));
}

TEST_CASE("past the limit point the shallow bar snaps to the branch on the other side") {
  const double limit_height = std::sqrt((1 - 10 * S_pre / E) / 3), limit = load_at(limit_height);
  CHECK(limit_height - 1 == Approx(-0.422651105).epsilon(1e-6));
  CHECK(limit == Approx(36147586.37).epsilon(1e-6));
  CHECK(top_displacement(0.999 * limit, 50) > limit_height - 1);
  const double snapped = top_displacement(3.626e7, 50);
  CHECK(snapped == Approx(height_at(3.626e7, -2, -1) - 1).epsilon(1e-9));
  CHECK(snapped == Approx(-2.155).epsilon(1e-3));
}
