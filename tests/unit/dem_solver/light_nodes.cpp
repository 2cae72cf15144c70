#include "dem_solver/boundary/light_nodes.hpp"

#include <catch2/catch.hpp>
#include <limits>

using namespace talus;
using namespace talus::dem;

namespace {

/// One wire between two nodes.
Boundary one_wire() {
  mesh::Surface surface{.positions = {0, 0, 0, 1, 0, 0}, .segments = {{0, 1}}};
  surface.parts = {{.name = "wire", .segment_end = 1}};
  return Boundary(surface, std::vector<Index>{0});
}

}  // namespace

TEST_CASE("a light boundary gives way as a free mass does, and a held node not at all") {
  constexpr double mass = 0.04, force = 30, step = 4e-6;
  constexpr int steps = 125;
  Boundary boundary = one_wire();
  LightNodes nodes(std::vector<double>{mass, std::numeric_limits<double>::infinity()}, 0);
  nodes.begin_window(std::vector<double>(6, 0));
  for (int k = 0; k < steps; ++k) {
    boundary.clear_reactions();
    boundary.react(boundary.features()[0], {0.5, 0.5, 0},
                   {0, 0, force});  // on the sphere; a half on each node
    nodes.answer(boundary, step);
  }
  const double acceleration = -0.5 * force / mass;
  CHECK(nodes.velocity(0).z == Approx(acceleration * steps * step).epsilon(1e-12));
  CHECK(nodes.displacement()[2] ==
        Approx(acceleration * step * step * steps * (steps + 1) / 2).epsilon(1e-12));
  CHECK(nodes.velocity(1).z == 0);
  CHECK(nodes.displacement()[5] == 0);
}

TEST_CASE(
    "the answer of light nodes is added to the motion they are given, and forgotten in the next window") {
  Boundary boundary = one_wire();
  LightNodes nodes(std::vector<double>{2, 2}, 0);
  boundary.react(boundary.features()[0], {1, 0, 0}, {0, 0, -8});
  nodes.answer(boundary, 0.5);
  const std::vector<double> given{0.1, 0, 0, 0, 0, 0}, speed{0, 3, 0, 0, 0, 0};
  boundary.move({.start_displacement = given, .start_velocity = speed}, {});
  nodes.displace(boundary);
  CHECK(boundary.position(0).x == 0.1);
  CHECK(boundary.position(0).z == 0.5 * (0.5 * 8 / 2));
  CHECK(boundary.velocity(0).y == 3);
  CHECK(boundary.velocity(0).z == 0.5 * 8 / 2);
  CHECK(boundary.position(1).z == 0);
  nodes.begin_window(std::vector<double>(6, 0));
  CHECK(nodes.velocity(0).z == 0);
}

TEST_CASE("a light node starts a window with the impulse that the structure has not had yet") {
  LightNodes nodes(std::vector<double>{2, std::numeric_limits<double>::infinity()}, 0);
  nodes.begin_window(std::vector<double>{0, 0, -3, 0, 0, -3});
  CHECK(nodes.velocity(0).z == -3 / 2.0);
  CHECK(nodes.velocity(1).z == 0);
}

TEST_CASE("a light node gives way along the force that it bears, in every direction") {
  Boundary boundary = one_wire();
  LightNodes nodes(std::vector<double>{2, 4}, 0);
  nodes.begin_window(std::vector<double>(6, 0));
  boundary.react(boundary.features()[0], {0.5, 0.5, 0}, {-8, 16, 32});  // on the sphere; a half on each node
  nodes.answer(boundary, 0.5);
  CHECK(nodes.velocity(0).x == 0.5 * 4 / 2);
  CHECK(nodes.velocity(0).y == 0.5 * -8 / 2);
  CHECK(nodes.velocity(0).z == 0.5 * -16 / 2);
  CHECK(nodes.velocity(1).x == 0.5 * 4 / 4);
  CHECK(nodes.velocity(1).y == 0.5 * -8 / 4);
}

TEST_CASE(
    "a boundary on a parabola has the speed of its chord halfway, and that of its ends' change beside it") {
  const std::vector<double> u0{0, 0, 0}, u1{1, 2, 3}, v0{0, 0, 0}, v1{4, 6, 8};
  const Boundary::Motion motion{.start_displacement = u0,
                                .start_velocity = v0,
                                .end_displacement = u1,
                                .end_velocity = v1,
                                .length = 0.5};
  for (const double x : {0.0, 0.5, 1.0}) {
    CHECK(motion.velocity(0, x).x == 1 / 0.5 + 4 * (x - 0.5));
    CHECK(motion.velocity(0, x).y == 2 / 0.5 + 6 * (x - 0.5));
    CHECK(motion.velocity(0, x).z == 3 / 0.5 + 8 * (x - 0.5));
  }
}
