#include <catch2/catch.hpp>

#include "fem_solver/integration/static_solver.hpp"
#include "tests/support/structures.hpp"

// Shapes found from prestress: a cable whose stiffness is nothing beside its prestress pulls with the force
// density q = A S_pre/L times the vector between its nodes, whatever its length, so the shape follows from
// linear equations (Schek, The force density method, 1974): every free node is the mean of its neighbours,
// weighted by q.
namespace {

using namespace talus::fem;
namespace tests = talus::tests;

constexpr double softness = 1.0;  // Pa; beside prestress of 1e8 Pa and more it moves nodes by 1e-8

AxialPart stressed(double prestress) {
  return {.section = {.area = 1e-5, .youngs_modulus = softness, .prestress = prestress}, .density = 7850};
}

Support led_to(Index node, const Vector3& displacement) {
  Support support = tests::fixed({node});
  support.displacement = displacement;
  return support;
}

std::vector<double> shape_of(const Model& model) {
  Assembly assembly(model);
  StaticSolver solver(model, assembly, {.end = 1, .step = 1});
  solver.advance(0, 1);
  std::vector<double> positions(model.reference);
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] += solver.displacement()[i];
  return positions;
}

}  // namespace

TEST_CASE("the node of a four-cable net settles at the mean of its anchors weighted by force densities") {
  // Laid out flat, then its four anchors are led to where they belong.
  const Vector3 anchors[] = {{0, 0, 0.3}, {1.2, 0.1, -0.2}, {1, 1, 0.9}, {-0.1, 1, 0}};
  const double prestress[] = {1e8, 2e8, 3e8, 1.5e8};
  Model model;
  model.reference = {0.4, 0.5, 0};
  for (const Vector3& anchor : anchors)
    model.reference.insert(model.reference.end(), {anchor.x(), anchor.y(), 0.0});
  Vector3 weighted = Vector3::Zero();
  double densities = 0;
  for (Index k = 0; k < 4; ++k) {
    tests::add_part<CableBatch>(model, "cable " + std::to_string(k), stressed(prestress[k]), {{0, k + 1}});
    model.supports.push_back(led_to(k + 1, Vector3(0, 0, anchors[k].z())));
    const double density = prestress[k] / (model.position(k + 1) - model.position(0)).norm();
    weighted += density * anchors[k];
    densities += density;
  }
  const std::vector<double> shape = shape_of(model);
  CHECK((Vector3::Map(shape.data()) - weighted / densities).norm() < 1e-7);
}

TEST_CASE("a square net of one prestress between straight edges finds the hyperbolic paraboloid") {
  // z = c x y solves the net's equations exactly: each node is the mean of its four neighbours.
  constexpr Index n = 9;
  constexpr double pitch = 0.25, c = 0.4;
  Model model = tests::net<CableBatch>(stressed(1e8), pitch, n);
  const std::vector<Index> rim = model.supports.front().nodes;
  model.supports.clear();
  for (const Index node : rim)
    model.supports.push_back(
        led_to(node, Vector3(0, 0, c * model.position(node).x() * model.position(node).y())));
  const std::vector<double> shape = shape_of(model);
  for (std::size_t node = 0; node < shape.size(); node += 3) {
    CHECK(shape[node] == Approx(model.reference[node]).margin(1e-7));
    CHECK(shape[node + 2] == Approx(c * model.reference[node] * model.reference[node + 1]).margin(1e-7));
  }
}
