// Stiffness damping belongs to the material: it turns with the elements, takes energy and never gives any.
#include <catch2/catch.hpp>

#include "fem_solver/integration/explicit.hpp"
#include "fem_solver/integration/implicit_solver.hpp"
#include "fem_solver/integration/static_solver.hpp"
#include "tests/support/structures.hpp"
#include "tests/unit/fem_solver/elements_support.hpp"

using namespace talus::fem;
using namespace talus::test;
namespace tests = talus::tests;

namespace {

const PlaneElasticity sheet = PlaneElasticity::from(OrthotropicSheet{3e5, 1e5, 0.2, 2e4});
const AxialPart line{{1e-4, 1e7, 1e5}, 7850};
const std::vector<std::array<Index, 2>> segments{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}};
const std::vector<std::array<Index, 3>> triangles{{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}, {1, 5, 3}};

template <class Law>
ElementBatch membrane(const std::vector<double>& nodes) {
  return MembraneBatch<Law>({0.01, 1000, Vector3(1, 0.2, 0.1)}, Law(sheet, {500, 200, 0}), triangles, nodes);
}

/// One of every kind over six nodes.
std::vector<ElementBatch> every_kind(const std::vector<double>& nodes) {
  const BrakeLaw brake(
      {.table = {{0.01, 100}, {0.05, 120}, {0.1, 125}}, .stop_stiffness = 1e5, .stop_width = 0.01});
  std::vector<ElementBatch> kinds;
  kinds.push_back(BarBatch(line, segments, nodes));
  kinds.push_back(CableBatch(line, segments, nodes));
  kinds.push_back(SlidingCableBatch(line, 0, segments, nodes));
  kinds.push_back(FrictionalCableBatch({.part = line, .friction = {0.2}, .gap = 0}, segments, nodes));
  kinds.push_back(BrakeBatch({brake, 1}, segments, nodes));
  kinds.push_back(ElasticPlasticBatch({ElasticPlasticRope{line.section, 2e5, 1e6}, 1}, segments, nodes));
  kinds.push_back(BreakingRopeBatch(SlidingCableBatch(line, 0, segments, nodes), {}));
  kinds.push_back(PenaltySlideBatch({{0, 1, 2}, {3, 4}}, 1e3, nodes));
  kinds.push_back(membrane<LinearSheet>(nodes));
  kinds.push_back(membrane<TensionField<ExactWrinkles>>(nodes));
  kinds.push_back(membrane<TensionField<PrincipalWrinkles>>(nodes));
  return kinds;
}

/// A ring of four nodes and one of two, that may break or not.
std::vector<ElementBatch> rings(const std::vector<double>& nodes) {
  const RingLaw law({4.6, 100}, {5, 1000});
  const std::vector<std::array<Index, 2>> sides{{0, 1}, {1, 3}, {3, 2}, {2, 0}, {2, 5}, {5, 2}};
  std::vector<ElementBatch> kinds;
  kinds.push_back(PlainRingBatch({law, 1, 1}, sides, nodes));
  kinds.push_back(BreakingRingBatch({{law, {.force = 800}}, 1, 1}, sides, nodes));
  return kinds;
}

Model model_of(const std::vector<double>& nodes, ElementBatch batch) {
  Model model;
  model.reference = nodes;
  model.parts.push_back({"part", std::move(batch), {0, 1, 2, 3, 4, 5}});
  lump_masses(model);
  for (double& mass : model.node_masses) mass += 1;
  damp_by_stiffness(model, 1);
  return model;
}

std::vector<double> nodes_at_random(Dice& dice) {
  std::vector<double> nodes{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0};
  for (double& x : nodes) x += dice.uniform(-0.1, 0.1);
  return nodes;
}

Eigen::VectorXd damping_force(Assembly& assembly, const Eigen::VectorXd& u, const Eigen::VectorXd& v) {
  Eigen::VectorXd force(u.size());
  assembly.damping_force(span_of(u), span_of(v), {force.data(), static_cast<std::size_t>(force.size())});
  return force;
}

/// In one state of a kind, drawn from the dice.
void check_damping(ElementBatch kind, const std::vector<double>& nodes, Dice& dice) {
  const Model model = model_of(nodes, std::move(kind));
  const std::string name =
      std::visit([](const auto& b) { return std::string(b.called()); }, model.parts[0].elements);
  CAPTURE(name);
  Assembly assembly(model);
  const double size = dice.decades(1e-3, 0.3);
  Eigen::VectorXd u(18), v(18), rigid(18);
  for (Eigen::Index i = 0; i < 18; ++i) {
    u[i] = dice.uniform(-size, size);
    v[i] = dice.uniform(-5, 5);
  }
  const Vector3 along = dice.vector(3), spin = dice.vector(3);
  for (Index k = 0; k < 6; ++k)
    rigid.segment<3>(3 * k) = along + spin.cross(model.position(k) + u.segment<3>(3 * k));
  const Eigen::VectorXd force = damping_force(assembly, u, v);
  const double scale = 1e4;  // N s/m, of the stiffest of them
  CHECK(force.dot(v) >= -1e-12 * scale);
  CHECK(damping_force(assembly, u, rigid).norm() < 1e-11 * scale);
  Eigen::VectorXd by_matrix = Eigen::VectorXd::Zero(18);
  std::visit(
      [&](const auto& batch) {
        batch.damping_matrix(span_of(u), [&](Index row, Index column, const Matrix3& block) {
          by_matrix.segment<3>(3 * row) += block * v.segment<3>(3 * column);
        });
      },
      model.parts[0].elements);
  CHECK((by_matrix - force).norm() < 1e-11 * scale);
}

}  // namespace

TEST_CASE("damping of every kind of element takes energy, leaves rigid motions alone and is its own matrix") {
  Dice dice(81), dice_of_rings(83);
  for (int trial = 0; trial < 40; ++trial) {
    CAPTURE(trial);
    const std::vector<double> nodes = nodes_at_random(dice);
    for (ElementBatch& kind : every_kind(nodes)) check_damping(std::move(kind), nodes, dice);
    for (ElementBatch& kind : rings(nodes)) check_damping(std::move(kind), nodes, dice_of_rings);
  }
}

TEST_CASE("a slack rope and a slack sheet feel no damping") {
  Dice dice(82);
  const std::vector<double> nodes = nodes_at_random(dice);
  Eigen::VectorXd together(18), v = Eigen::VectorXd::Random(18);
  for (Eigen::Index i = 0; i < 18; ++i) together[i] = -0.3 * nodes[static_cast<std::size_t>(i)];  // shrunk
  std::vector<ElementBatch> kinds = every_kind(nodes);
  for (ElementBatch& kind : rings(nodes)) kinds.push_back(std::move(kind));
  for (ElementBatch& kind : kinds) {
    const Model model = model_of(nodes, std::move(kind));
    const std::string name =
        std::visit([](const auto& b) { return std::string(b.called()); }, model.parts[0].elements);
    CAPTURE(name);
    Assembly assembly(model);
    const bool presses = name == "bars" ||
                         std::holds_alternative<PlainMembraneBatch>(model.parts[0].elements) ||
                         std::holds_alternative<PenaltySlideBatch>(model.parts[0].elements);
    CHECK((damping_force(assembly, together, v).norm() == 0) == !presses);
  }
}

TEST_CASE("a taut bar that spins keeps its angular momentum under stiffness damping, explicit and implicit") {
  // Turned by its own tangent the damping would brake the spin: by b N/(m L) a second, here to 1e-3 of it.
  const AxialPart taut{{1e-4, 1e9, 5e7}, 7850};
  const double spin = 30, step = 2e-5, time = 0.2, seconds = 2e-4;
  const auto momentum = [](const Model& model, std::span<const double> u, std::span<const double> v) {
    Vector3 sum = Vector3::Zero();
    for (Index k = 0; k < model.nodes(); ++k)
      sum += model.node_masses[static_cast<std::size_t>(k)] *
             (model.position(k) + Vector3::Map(&u[3 * k])).cross(Vector3::Map(&v[3 * k]));
    return sum;
  };
  Model model = tests::chain<BarBatch>(taut, 1, 1);
  damp_by_stiffness(model, seconds);
  for (const Index node : {0, 1})
    model.initial_velocities.push_back({{node}, Vector3(0, spin * (node - 0.5), 0)});
  const Vector3 start = momentum(model, initial_state(model).displacement, initial_state(model).velocity);
  SECTION("explicit") {
    Assembly assembly(model);
    ExplicitSolver solver(model, assembly, step);
    for (double now = 0; now < time; now += 1e-2) solver.advance(now, 1e-2);
    const Vector3 end = momentum(model, solver.state().displacement, solver.state().velocity);
    CHECK((end - start).norm() < 2e-3 * start.norm());  // the velocity is that of half a step before
    CHECK(solver.balance().bulk_damping > 0);           // the vibration along it is gone
  }
  SECTION("implicit") {
    // The method itself keeps it to 1e-3 at this step; what damping adds is of second order in the step.
    const auto change_at = [&](double damping, double step_length) {
      damp_by_stiffness(model, damping);
      Assembly assembly(model);
      ImplicitSolver solver(model, assembly, {.step = step_length, .spectral_radius = 1});
      for (double now = 0; now < time; now += 1e-2) solver.advance(now, 1e-2);
      return ((momentum(model, solver.state().displacement, solver.state().velocity) - start).norm()) /
             start.norm();
    };
    const double coarse = change_at(seconds, 1e-3), fine = change_at(seconds, 5e-4);
    CHECK(coarse < 1e-2);
    CHECK(fine < 0.3 * coarse);
  }
}
