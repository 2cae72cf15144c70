#include "interface_mesh/closest_point.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/support/random_point.hpp"

using namespace talus;
using core::Vector3;

TEST_CASE("the closest point of a segment is its foot point or an end") {
  const std::array<Vector3, 2> ends{Vector3(1, 0, 0), Vector3(3, 0, 0)};
  const auto inside = mesh::closest_on_segment({1.5, 2, 0}, ends);
  CHECK(inside.weights == std::array{0.75, 0.25});
  CHECK(inside.distance_squared == 4);
  CHECK(mesh::closest_on_segment({-1, 1, 0}, ends).weights == std::array{1.0, 0.0});
  CHECK(mesh::closest_on_segment({9, 1, 0}, ends).weights == std::array{0.0, 1.0});
}

TEST_CASE("the closest point of a triangle has the exact weights 1 and 0 at its corners") {
  std::mt19937 random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const std::array corners{tests::random_point(random), tests::random_point(random),
                             tests::random_point(random)};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto closest = mesh::closest_on_triangle(corners[corner], corners);
      CHECK(closest.weights[corner] == 1);
      CHECK(closest.distance_squared == 0);
    }
  }
}

// Nearest point of a convex set: no point of the set lies in front of the plane through it, normal to the way
// to p.
TEST_CASE("the closest point of a triangle satisfies the variational inequality against all corners") {
  std::mt19937 random(6);
  for (int trial = 0; trial < 20000; ++trial) {
    const std::array corners{tests::random_point(random), tests::random_point(random),
                             tests::random_point(random)};
    const Vector3 p = 2 * tests::random_point(random);
    const auto closest = mesh::closest_on_triangle(p, corners);
    const auto& w = closest.weights;
    const Vector3 q = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
    REQUIRE(std::abs(w[0] + w[1] + w[2] - 1) < 1e-14);
    REQUIRE(std::min({w[0], w[1], w[2]}) >= -1e-15);
    REQUIRE(std::abs((p - q).squaredNorm() - closest.distance_squared) < 1e-14);
    // Round-off of slivers: weights are quotients of areas, so the error grows as the triangle flattens.
    for (const auto& corner : corners) REQUIRE((p - q).dot(corner - q) < 1e-9);
  }
}
