// Rings: closed polygons through the nodes where their neighbours touch, that bend and then stretch.
#include <catch2/catch.hpp>

#include <numbers>

#include "core/errors.hpp"
#include "fem_solver/assembly/assembly.hpp"
#include "tests/support/finite_differences.hpp"
#include "tests/unit/fem_solver/elements_support.hpp"

using namespace talus;
using namespace talus::fem;
using namespace talus::test;

namespace {

using Sides = std::vector<std::array<Index, 2>>;

const RingDescription seven{.windings = 7, .wire_diameter = 0.003, .inner_diameter = 0.3, .strength = 1.77e9};

/// A ring of four nodes, one of two and one of three, that share nodes.
const Sides three_rings{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {2, 4}, {4, 2}, {4, 5}, {5, 2}, {2, 4}};
std::vector<double> near_round(Dice& dice) {
  std::vector<double> nodes{0.15, 0, 0, 0, 0.15, 0, -0.15, 0, 0, 0, -0.15, 0, -0.45, 0, 0, -0.3, 0.15, 0};
  for (double& x : nodes) x += dice.uniform(-0.004, 0.004);
  return nodes;
}

RingBatch<RingLaw>::Description plain(const RingLaw& law) {
  return {.law = law, .mass = 1, .inner_diameter = 0.3};
}
RingBatch<Breaking<RingLaw>>::Description breaking(const RingLaw& law) {
  return {.law = {law, {.force = law.breaking().tension}}, .mass = 1, .inner_diameter = 0.3};
}

Model model_of(const std::vector<double>& nodes, ElementBatch batch) {
  Model model;
  model.reference = nodes;
  model.parts.push_back({"rings", std::move(batch), {}});
  lump_masses(model);
  return model;
}

double joules(const ElementBatch& elements, const Configuration& at) {
  return std::visit(
      [&](const auto& batch) {
        if constexpr (Remembers<std::decay_t<decltype(batch)>>)
          return batch.energy(at) + batch.dissipated(at);
        else
          return batch.energy(at);
      },
      elements);
}

}  // namespace

TEST_CASE(
    "the force of rings is the derivative of what they store and dissipate, its stiffness that of the "
    "force") {
  Dice dice(91);
  const RingLaw law = ring_law(seven);
  int compared = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<double> nodes = near_round(dice);
    const bool may_break = trial % 2 == 1;
    const Model model =
        model_of(nodes, may_break ? ElementBatch(BreakingRingBatch(breaking(law), three_rings, nodes))
                                  : ElementBatch(PlainRingBatch(plain(law), three_rings, nodes)));
    Assembly assembly(model);
    std::vector<double> memory;
    for (int ring = 0; ring < 3; ++ring) memory.push_back(std::max(0.0, dice.uniform(-0.2, 0.4)));
    if (may_break) memory[1] = -3;  // has broken
    Eigen::VectorXd u(18), w(18);
    for (Eigen::Index i = 0; i < 18; ++i) {
      u[i] = dice.uniform(-0.15, 0.15);
      w[i] = dice.uniform(-1, 1);
    }
    const auto force = [&](const Eigen::VectorXd& at) {
      Eigen::VectorXd f(18);
      assembly.internal_force({span_of(at), memory}, {f.data(), 18});
      return Eigen::VectorXd(-f);
    };
    const auto along = [&](double step) {
      return Eigen::VectorXd((force(u + step * w) - force(u - step * w)) / (2 * step));
    };
    constexpr double step = 1e-7;  // m
    const Eigen::VectorXd fine = along(step);
    const double stiffness = 4e7;                                      // N/m, of stretch in four sides
    if ((fine - along(4 * step)).norm() > 1e-5 * stiffness) continue;  // across a kink of the law
    ++compared;
    const ElementBatch& rings = model.parts[0].elements;
    const double slope = (joules(rings, {span_of(Eigen::VectorXd(u + step * w)), memory}) -
                          joules(rings, {span_of(Eigen::VectorXd(u - step * w)), memory})) /
                         (2 * step);
    CHECK(slope == Approx(force(u).dot(w)).margin(1e-6 * stiffness));
    Eigen::VectorXd product(18), blocks = Eigen::VectorXd::Zero(18), stiffest(18);
    assembly.stiffness_product({span_of(u), memory}, span_of(w), {product.data(), 18});
    std::visit(
        [&](const auto& batch) {
          batch.stiffness({span_of(u), memory}, [&](Index row, Index column, const Matrix3& block) {
            blocks.segment<3>(3 * row) += block * w.segment<3>(3 * column);
          });
        },
        rings);
    CHECK((fine - product).norm() < 2e-6 * stiffness);
    CHECK((blocks - product).norm() < 1e-12 * stiffness);
    assembly.stiffest_product({span_of(u), memory}, span_of(w), {stiffest.data(), 18});
    CHECK(w.dot(stiffest) >= w.dot(product) - 1e-12 * stiffness);
  }
  CHECK(compared > 150);
}

TEST_CASE("rings pull with no force and no moment on the whole") {
  Dice dice(92);
  for (int trial = 0; trial < 50; ++trial) {
    const std::vector<double> nodes = near_round(dice);
    const Model model = model_of(nodes, PlainRingBatch(plain(ring_law(seven)), three_rings, nodes));
    Assembly assembly(model);
    Eigen::VectorXd u(18), f(18);
    for (Eigen::Index i = 0; i < 18; ++i) u[i] = dice.uniform(-0.3, 0.3);
    assembly.internal_force(span_of(u), {f.data(), 18});
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
    for (Index k = 0; k < 6; ++k) {
      force += f.segment<3>(3 * k);
      moment += (model.position(k) + u.segment<3>(3 * k)).cross(f.segment<3>(3 * k));
    }
    CHECK(force.norm() < 1e-9 * (1 + f.norm()));
    CHECK(moment.norm() < 1e-9 * (1 + f.norm()));
  }
}

TEST_CASE(
    "a chain of three rings bears what the tests have measured, and 15 % of it at 85 % of the elongation") {
  const std::vector<double> line{0, 0, 0, 0.3, 0, 0, 0.6, 0, 0, 0.9, 0, 0};
  const Sides chain{{0, 1}, {1, 0}, {1, 2}, {2, 1}, {2, 3}, {3, 2}};
  const auto check = [&](int windings, double force, double elongation) {
    RingDescription ring = seven;
    ring.windings = windings;
    const Model model = model_of(line, PlainRingBatch(plain(ring_law(ring)), chain, line));
    Assembly assembly(model);
    const auto pull = [&](double stretch) {
      std::vector<double> u(12, 0.0), f(12);
      for (std::size_t k = 1; k < 4; ++k) u[3 * k] = stretch * double(k) / 3;
      assembly.internal_force(u, f);
      return -f[9];
    };
    CHECK(pull(0) == 0);
    CHECK(pull(elongation) == Approx(force).epsilon(1e-9));
    CHECK(pull(0.85 * elongation) == Approx(0.15 * force).epsilon(1e-9));
  };
  check(5, 44.94e3, 0.519);
  check(9, 80.55e3, 0.490);
  check(16, 177.66e3, 0.476);
  // Between them by 1/n: 12 is 4/7 of the way from 1/9 to 1/16.
  check(12, 12 * (80.55e3 / 9 + 4. / 7 * (177.66e3 / 16 - 80.55e3 / 9)), 0.490 - 4. / 7 * 0.014);
  // Beyond them every winding bears the same.
  check(19, 19 * 177.66e3 / 16, 0.476);
  check(3, 3 * 44.94e3 / 5, 0.519);
}

TEST_CASE(
    "tensions are in proportion to the wire's section and strength, perimeters to the ring's diameter") {
  RingDescription other = seven;
  other.wire_diameter *= 2;
  other.strength /= 3;
  other.inner_diameter *= 1.5;
  const RingLaw one = ring_law(seven), two = ring_law(other);
  CHECK(two.breaking().tension == Approx(4. / 3 * one.breaking().tension).epsilon(1e-12));
  CHECK(two.straight().tension == Approx(4. / 3 * one.straight().tension).epsilon(1e-12));
  CHECK(two.breaking().perimeter == Approx(1.5 * one.breaking().perimeter).epsilon(1e-12));
  CHECK(two.straight().perimeter == Approx(1.5 * one.straight().perimeter).epsilon(1e-12));
}

TEST_CASE("a straight ring stretches alike through two nodes and through four") {
  const RingLaw law = ring_law(seven);
  const double round = 0.3,
               diagonal = round / std::numbers::sqrt2;  // p_0 of two nodes is 2 D, of four 4 D/sqrt 2
  for (const double perimeter : {1.001 * law.straight().perimeter, law.breaking().perimeter}) {
    const double two = law.respond({perimeter, 2 * round}, 0).force,
                 four = law.respond({perimeter, 4 * diagonal}, 0).force;
    CHECK(four == Approx(two).epsilon(1e-12));
  }
  CHECK(law.respond({law.straight().perimeter, 4 * diagonal}, 0).force ==
        Approx(law.straight().tension).epsilon(1e-12));
}

TEST_CASE("what bending and drawing taut have done to a ring stays, and 0.4 % of its length comes back") {
  const RingLaw law = ring_law(seven);
  const double p0 = 0.6, knee = law.straight().perimeter, most = law.breaking().perimeter;
  const double kept = law.respond({most, p0}, 0).history;
  CHECK(kept == Approx(most - p0));
  // Slack again 0.4 % of the perimeter before, along a straight line.
  const double back = 0.004 * most;
  CHECK(law.respond({most - 0.25 * back, p0}, kept).force == Approx(0.75 * law.breaking().tension));
  CHECK(law.respond({most - 1.0001 * back, p0}, kept).force == 0);
  CHECK(law.respond({most - 0.25 * back, p0}, kept).history == kept);
  CHECK(law.stored({most, p0}, kept) == Approx(0.5 * law.breaking().tension * back));
  // 15 % of the force over 85 % of the way, then up to the whole: bending and stretch as areas.
  const double bending = 0.5 * law.straight().tension * (knee - p0),
               stretch = 0.5 * (law.straight().tension + law.breaking().tension) * (most - knee);
  CHECK(law.stored({most, p0}, kept) + law.dissipated({most, p0}, kept) == Approx(bending + stretch));
}

TEST_CASE("lines that do not close, and polygons longer than their ring, are refused with the place") {
  using Catch::Matchers::Contains;
  const std::vector<double> nodes{0, 0, 0, 0.3, 0, 0, 0.3, 0.3, 0, 0, 0.3, 0};
  const RingLaw law = ring_law(seven);
  CHECK_THROWS_WITH(PlainRingBatch(plain(law), Sides({{0, 1}, {1, 2}}), nodes),
                    Contains("begins at (0, 0, 0) m ends at (0.3, 0.3, 0) m"));
  CHECK_THROWS_WITH(PlainRingBatch(plain(law), Sides({{0, 1}, {1, 2}, {2, 3}, {3, 0}}), nodes),
                    Contains("that at (0, 0, 0) m is 1.2 m long"));
  CHECK_THROWS_AS(PlainRingBatch(plain(law), Sides({{0, 1}, {1, 0}, {2, 3}}), nodes), core::ConfigError);
}
