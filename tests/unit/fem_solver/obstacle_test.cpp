#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "fem_solver/integration/explicit.hpp"
#include "tests/unit/fem_solver/elements_support.hpp"
#include "tests/unit/fem_solver/structural_scenes.hpp"

using namespace talus::fem;
using namespace talus::test;
using Catch::Matchers::Contains;

namespace {

/// A weight on a slack thread above an inclined plane through the origin that falls along x.
std::string weight_on_incline(double angle, double friction, const std::string& method) {
  const double g = 9.81;
  return fmt::format(
      "  gravity: [{}, 0, {}]\n"
      "  parts: {{thread: {{polyline: {{points: [[0, 0, 0], [0, 0, 1]]}}, cable: {{area: 1 mm^2, density: "
      "1000, "
      "youngs_modulus: 1 kPa}}, gravity: [0, 0, 0]}}}}\n"
      "  point_masses: [{{nodes: thread.start, mass: 2 kg}}]\n"
      "  supports: [{{nodes: thread.end, fix: xyz}}]\n"
      "  obstacles: {{ground: {{plane: {{point: [0, 0, 0], normal: [0, 0, 3]}}, nodes: [thread.start], "
      "friction: {}, stiffness: 10 MN/m}}}}\n"
      "  initial_displacements: [{{nodes: thread.start, displacement: [0, 0, {}]}}]\n  {}\n",
      g * std::sin(angle), -g * std::cos(angle), friction, -2 * g * std::cos(angle) / 1e7, method);
}

double total(const EnergyBalance& b) {
  double sum = b.kinetic + b.gravity + b.bulk_damping - b.loads;
  for (const double joules : b.elastic) sum += joules;
  for (const double joules : b.dissipated) sum += joules;
  return sum;
}

}  // namespace

TEST_CASE("the force of a plane is the derivative of its energy, and its tangent that of its force") {
  Dice dice(91);
  for (int trial = 0; trial < 200; ++trial) {
    const PlaneContact plane{.point = dice.vector(1),
                             .normal = dice.vector(1).normalized(),
                             .distance = dice.uniform(0, 0.1),
                             .friction = trial % 2 == 0 ? 0 : dice.uniform(0.1, 1),
                             .stiffness = dice.decades(1e2, 1e6)};
    const Vector3 place = plane.point + plane.along(dice.vector(1)) + dice.uniform(-0.1, 0.2) * plane.normal;
    PlaneContact::Memory before{.touches = true};
    before.anchor = place + plane.along(dice.vector(0.01 * dice.uniform(0, 1)));
    const auto force = [&](const Vector3& x) {
      return Vector3(plane.pressing(x) + plane.stiffness * plane.follow(x, before).stretch);
    };
    const PlaneContact::Memory after = plane.follow(place, before);
    const double step = 1e-7;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 h = step * Vector3::Unit(axis);
      // the anchor held: what is stored is what the force does
      const double slope = (plane.energy(place + h, after) - plane.energy(place - h, after)) / (2 * step);
      CHECK(slope == Approx(force(place)[axis]).margin(1e-6 * plane.stiffness));
      if (plane.friction > 0) continue;
      const Vector3 change = (force(place + h) - force(place - h)) / (2 * step);
      CHECK((change - plane.tangent(place, before).col(axis)).norm() < 1e-5 * plane.stiffness);
    }
    CHECK(plane.stiffness * after.stretch.norm() <=
          plane.friction * plane.stiffness * plane.depth(place) * (1 + 1e-12));
    CHECK(after.dissipated >= 0);
  }
}

TEST_CASE("a weight on an incline slides as Coulomb's law says, or sticks, by every method through time") {
  const double angle = 0.5, g = 9.81, t = 0.2;
  for (const std::string method : {"explicit: {}", "implicit: {spectral_radius: 0.9}"}) {
    CAPTURE(method);
    for (const double friction : {0.0, 0.3, 0.8}) {
      CAPTURE(friction);
      Structure structure(tests::scene(weight_on_incline(angle, friction, method + "\n  step: 0.2 ms")));
      Integrator& run = structure.integrator();
      for (int k = 0; k < 20; ++k) run.advance(0.01 * k, 0.01);
      const double a = std::max(0.0, g * (std::sin(angle) - friction * std::cos(angle)));
      // the tangential spring gives way before it holds or slides: half a millisecond of speed, 0.1 mm
      CHECK(run.displacement()[0] == Approx(0.5 * a * t * t).margin(2e-4));
      const EnergyBalance now = run.balance();
      const double heat = friction * 2 * g * std::cos(angle) * (0.5 * a * t * t);
      CHECK(now.dissipated[1] == Approx(a > 0 ? heat : 0).margin(0.02 * heat + 5e-3));
      CHECK(std::abs(total(now)) < 5e-3);  // starts at g depth/2 of pressed spring less weight's path: 4e-4 J
    }
  }
}

TEST_CASE("a net that falls on the ground lies on it with its weight") {
  Structure structure(tests::scene(
      "  gravity: [0, 0, -9.81]\n"
      "  parts: {net: {square_net: {corner: [0, 0, 0.02], size: [1, 1], pitch: 0.25}, cable: {area: 10 mm^2, "
      "density: 7850, youngs_modulus: 1 GPa}}}\n"
      "  damping: {mass: 100 1/s}\n"
      "  obstacles: {ground: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, nodes: [net], friction: 0.4, "
      "distance: "
      "5 mm}}\n"
      "  explicit: {}\n"));
  Integrator& run = structure.integrator();
  for (int k = 0; k < 100; ++k) run.advance(0.01 * k, 0.01);
  double weight = 0;
  for (std::size_t i = 2; i < structure.model().weight.size(); i += 3) weight -= structure.model().weight[i];
  const Part& ground = structure.model().parts[1];
  const auto& batch = std::get<ObstacleBatch>(ground.elements);
  double carried = 0;
  for (Index e = 0; e < batch.size(); ++e)
    carried += batch.force(configuration_of(structure.model(), ground, run.state().configuration()), e);
  CHECK(carried == Approx(weight).epsilon(1e-3));
  for (std::size_t i = 2; i < run.displacement().size(); i += 3)
    CHECK(run.displacement()[i] == Approx(-0.015).margin(1e-4));
}

TEST_CASE("a net that sags onto the ground stays where each way to begin and to go on puts it") {
  // Held at its rim 5 cm above the ground, soft enough to reach it; nothing may move by more than 1 % of a free fall.
  const double time = 0.02, fall = 0.5 * 9.81 * time * time;
  const std::string net =
      "  gravity: [0, 0, -9.81]\n"
      "  parts: {net: {square_net: {corner: [0, 0, 0.05], size: [1, 1], pitch: 0.25}, cable: {area: 10 mm^2, "
      "density: "
      "7850, youngs_modulus: 1 MPa, prestress: 50 kPa}}}\n"
      "  supports: [{nodes: net.rim, fix: xyz}]\n"
      "  obstacles: {ground: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, nodes: [net], stiffness: 10 kN/m";
  for (const std::string& friction : {"", ", friction: 0.5"})
    for (const std::string& start : {"relaxation: {tolerance: 1e-7}", "equilibrium: {}"})
      for (const std::string& method : {"  explicit: {}\n", "  implicit: {}\n  step: 1 ms\n"}) {
        CAPTURE(friction, start, method);
        Structure structure(tests::scene(net + friction + "}}\n  start: {" + start + "}\n" + method));
        Integrator& run = structure.integrator();
        const std::vector<double> before(run.displacement().begin(), run.displacement().end());
        const Part& ground = structure.model().parts[1];
        const Configuration at = configuration_of(structure.model(), ground, run.state().configuration());
        double carried = 0;
        const auto& batch = std::get<ObstacleBatch>(ground.elements);
        for (Index e = 0; e < batch.size(); ++e) carried += batch.force(at, e);
        CHECK(carried > 0.1);  // N, of 4.6 N of net
        run.advance(0, time);
        double moved = 0;
        for (std::size_t i = 0; i < before.size(); ++i)
          moved = std::max(moved, std::abs(run.displacement()[i] - before[i]));
        CHECK(moved < 0.01 * fall);
      }
}

TEST_CASE("obstacles that cannot be met are refused with what is wrong") {
  const std::string net =
      "  parts: {net: {square_net: {corner: [0, 0, 0], size: [1, 1], pitch: 0.5}, cable: {area: 10 mm^2, "
      "density: "
      "7850, youngs_modulus: 1 GPa}}}\n";
  const auto ground = [&](const std::string& keys) {
    return tests::complaint(net + "  supports: [{nodes: net.rim, fix: xyz}]\n  obstacles: {ground: {" + keys +
                            "}}\n");
  };
  CHECK_THAT(ground("plane: {point: [0, 0, 0.1], normal: [0, 0, 1]}, nodes: [net]"),
             Contains("structure.obstacles.ground") && Contains("100 mm behind it at the start"));
  CHECK_THAT(ground("plane: {point: [0, 0, -1], normal: [0, 0, 1]}, nodes: [net.rim]"),
             Contains("supports hold all of them"));
  CHECK_THAT(ground("plane: {point: [0, 0, -1], normal: [0, 0, 0]}, nodes: [net]"),
             Contains("must not be zero"));
  CHECK_THAT(ground("nodes: [net]"), Contains("ground: needs `plane`"));
  CHECK_THAT(ground("plane: {point: [0, 0, -1], normal: [0, 0, 1]}, nodes: [nett]"), Contains("net"));
}
