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
