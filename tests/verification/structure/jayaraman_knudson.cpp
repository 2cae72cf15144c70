// H. B. Jayaraman, W. C. Knudson, A curved element for the analysis of cable structures, Computers &
// Structures 14 (1981): a cable under its weight and a point load. The reference is the exact catenary of
// that paper's data from its unloaded state, computed independently of this program.
#include <catch2/catch.hpp>
#include <cmath>

#include "fem_solver/integration/static_solver.hpp"
#include "tests/support/structures.hpp"

using namespace talus::fem;
namespace tests = talus::tests;

namespace {

constexpr double foot = 0.3048, pound = 4.4482216152605, inch = 0.0254;

}  // namespace

TEST_CASE("a loaded catenary of many cables comes to rest at the exact cable's displacement") {
  // Unstretched lengths 412.8837 and 613.0422 ft, span 1000 ft, 3.16 lb/ft, E 19e6 psi, A 0.85 in^2, 8 kip at
  // the joint of both.
  const double first = 412.8837 * foot, second = 613.0422 * foot, area = 0.85 * inch * inch;
  const double weight = 3.16 * pound / foot, g = 9.80665;
  const AxialPart cable{
      .section = {.area = area, .youngs_modulus = 19e6 * pound / (inch * inch), .prestress = 0},
      .density = weight / (g * area)};
  // A zigzag of the right lengths to start from: two straight lines that meet below the chord.
  const double span = 1000 * foot, x = (first * first - second * second + span * span) / (2 * span);
  const double z = -std::sqrt(first * first - x * x);
  constexpr Index divisions = 100;
  Model model;
  for (Index i = 0; i <= divisions; ++i)
    model.reference.insert(model.reference.end(), {x * i / divisions, 0, z * i / divisions});
  for (Index i = 1; i <= divisions; ++i)
    model.reference.insert(model.reference.end(), {x + (span - x) * i / divisions, 0, z - z * i / divisions});
  std::vector<std::array<Index, 2>> segments;
  for (Index i = 0; i < 2 * divisions; ++i) segments.push_back({i, i + 1});
  tests::add_part<CableBatch>(model, "cable", cable, std::move(segments));
  model.supports = {tests::fixed({0, 2 * divisions})};
  weigh(model, Vector3(0, 0, -g));
  model.loads = {tests::load(divisions, {0, 0, -8000 * pound})};
  model.loads[0].history.points = {{0.5, 0}, {1, 1}};
  Assembly assembly(model);
  StaticSolver solver(model, assembly, {.end = 0.5, .step = 0.1});
  solver.advance(0, 0.5);
  const Vector3 unloaded = Vector3::Map(&solver.displacement()[3 * divisions]);
  StaticSolver loaded(model, assembly, {.end = 1, .step = 0.1});
  loaded.advance(0, 1);
  const Vector3 moved = Vector3::Map(&loaded.displacement()[3 * divisions]) - unloaded;
  // The joint hangs at 400 ft; chords of 4 to 6 ft instead of an arc, and E taken by Green-Lagrange strain: a
  // few parts in 1e4.
  CHECK(moved.x() == Approx(-0.859365).epsilon(1e-3));
  CHECK(moved.z() == Approx(-5.625616).epsilon(1e-3));
}
