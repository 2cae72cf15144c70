#include <catch2/catch.hpp>

#include "tests/unit/fem_solver/structural_scenes.hpp"

using namespace talus::fem;

TEST_CASE("a hinged post between stays carries what the equilibrium of its top says") {
  // Top at (0, 0, h), anchors at (-a, +-b, 0), a pull H along x and a weight m g at the top:
  // 2 T a/s = H, post force = 2 T h/s + m g, s the length of a stay. Three groups of elements in one scene.
  const double h = 3, a = 2, b = 1.5, H = 4000, mass = 50, g = 9.81;
  Structure structure(tests::scene(
      "  gravity: [0, 0, -9.81]\n"
      "  parts:\n"
      "    post: {polyline: {points: [[0, 0, 0], [0, 0, 3]]}, bar: {area: 40 cm^2, density: 1e-6, "
      "youngs_modulus: 210 GPa}}\n"
      "    left: {polyline: {points: [[-2, 1.5, 0], [0, 0, 3]]}, cable: {area: 5 cm^2, density: 1e-6, "
      "youngs_modulus: 100 GPa}}\n"
      "    right: {polyline: {points: [[-2, -1.5, 0], [0, 0, 3]]}, cable: {area: 8 cm^2, density: 1e-6, "
      "youngs_modulus: 100 GPa, prestress: 0}}\n"
      "  weld: {tolerance: 1 mm}\n"
      "  point_masses: [{at: [0, 0, 3], mass: 50 kg}]\n"
      "  supports:\n"
      "    - {nodes: post.start, fix: xyz}\n"
      "    - {nodes: left.start, fix: xyz}\n"
      "    - {nodes: right.start, fix: xyz}\n"
      "  loads: [{at: [0, 0, 3], force: [4000 N, 0 N, 0 N]}]\n"
      "  static: {steps: 1}\n"));
  structure.integrator().advance(0, 1);
  const auto reactions = structure.integrator().reactions();  // post, left, right
  const double deflection = 1e-3;  // relative: stays stretch by 1e-4 and lean by as much
  const double pull = H / 2;       // along x, of each stay
  CHECK(reactions[0] == Approx(0).margin(deflection * H));
  CHECK(reactions[2] == Approx(H * h / a + mass * g).epsilon(deflection));
  for (const std::size_t stay : {3, 6}) {
    CHECK(reactions[stay] == Approx(-pull).epsilon(2 * deflection));
    CHECK(std::abs(reactions[stay + 1]) == Approx(pull * b / a).epsilon(2 * deflection));
    CHECK(reactions[stay + 2] == Approx(-pull * h / a).epsilon(2 * deflection));
  }
}

TEST_CASE("a post swings about its hinged foot with the period of a rod, not of half its mass at its head") {
  // Small swings of a rod of length L that hangs from one end: T = 2 pi sqrt(2 L/(3 g)). A stiff bar, so that it does
  // not bounce; let go 5 mm aside, it is at its lowest after a quarter.
  const double L = 3, g = 9.81, period = 2 * M_PI * std::sqrt(2 * L / (3 * g));
  Structure structure(tests::scene(
      "  gravity: [0, 0, -9.81]\n"
      "  parts:\n"
      "    post: {polyline: {points: [[0, 0, 0], [0, 0, -3]]}, bar: {area: 40 cm^2, density: 7850, "
      "youngs_modulus: 1 GPa}}\n"
      "  supports: [{nodes: post.start, fix: xyz}]\n"
      "  initial_displacements: [{nodes: post.end, displacement: [5 mm, 0 m, 0 m]}]\n"
      "  implicit: {}\n"
      "  step: 1 ms\n"));
  Integrator& run = structure.integrator();
  double crossing = 0, before = run.displacement()[3];
  for (int k = 0; crossing == 0 && k < 2000; ++k) {
    run.advance(1e-3 * k, 1e-3);
    const double now = run.displacement()[3];
    if (now <= 0) crossing = 1e-3 * (k + before / (before - now));
    before = now;
  }
  CHECK(crossing == Approx(period / 4).epsilon(1e-3));
}

TEST_CASE("the foot of a hanging post carries all of its weight") {
  Structure structure(tests::scene(
      "  gravity: [0, 0, -9.81]\n"
      "  parts:\n"
      "    post: {polyline: {points: [[0, 0, 0], [0, 0, -3]]}, bar: {area: 40 cm^2, density: 7850, "
      "youngs_modulus: 200 GPa, prestress: 1 MPa}}\n"
      "  supports: [{nodes: post.start, fix: xyz}]\n"
      "  static: {steps: 1}\n"));
  structure.integrator().advance(0, 1);
  CHECK(structure.integrator().reactions()[2] == Approx(40e-4 * 7850 * 3 * 9.81).epsilon(1e-6));
}

TEST_CASE("a part with gravity and damping of its own falls and slows down as they say") {
  // Two weights on slack ropes, 0.1 s: one on the moon, one in air that takes 20 1/s of its velocity.
  Structure structure(tests::scene(
      "  gravity: [0, 0, -9.81]\n"
      "  parts:\n"
      "    moon: {polyline: {points: [[0, 0, 0], [0, 0, 1]]}, cable: {area: 1 mm^2, density: 7850, "
      "youngs_modulus: 1 MPa}, gravity: [0, 0, -1.62]}\n"
      "    air: {polyline: {points: [[1, 0, 0], [1, 0, 1]]}, cable: {area: 1 mm^2, density: 7850, "
      "youngs_modulus: 1 MPa}, damping: {mass: 20 1/s}}\n"
      "  explicit: {}\n"
      "  step: 0.1 ms\n"));
  Integrator& run = structure.integrator();
  for (int k = 0; k < 10; ++k) run.advance(0.01 * k, 0.01);
  const double t = 0.1, rate = 20, limit = 9.81 / rate;
  CHECK(run.displacement()[2] == Approx(-0.5 * 1.62 * t * t).epsilon(1e-6));
  CHECK(run.displacement()[8] == Approx(-limit * (t - (1 - std::exp(-rate * t)) / rate)).epsilon(1e-4));
}
