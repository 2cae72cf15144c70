#include "interface_mesh/surface_checks.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "core/errors.hpp"

using namespace talus;
using mesh::Surface;

namespace {

Surface two_triangles() {
  return {.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0},
          .segments = {{0, 1}},
          .triangles = {{0, 1, 2}, {0, 2, 3}},
          .parts = {{.name = "sheet", .segment_end = 1, .triangle_end = 2}}};
}

std::string only_fault(const Surface& surface) {
  const auto found = mesh::faults(surface);
  REQUIRE(found.size() == 1);
  return found.front();
}

}  // namespace

TEST_CASE("a sound surface has no faults") {
  CHECK(mesh::faults(two_triangles()).empty());
}

TEST_CASE("a node that no cell uses is named with its coordinates") {
  auto surface = two_triangles();
  surface.positions.insert(surface.positions.end(), {2.5, -1, 0.25});
  CHECK(only_fault(surface) == "node 4 at (2.5, -1, 0.25) m belongs to no segment or triangle");
}

TEST_CASE("an index beyond the nodes is named with its cell") {
  auto surface = two_triangles();
  surface.triangles[1][2] = 4;
  CHECK(only_fault(surface) == "triangle 1 names node 4, but there are 4 nodes");
  surface = two_triangles();
  surface.segments[0][0] = -1;
  CHECK(only_fault(surface) == "segment 0 names node -1, but there are 4 nodes");
}

TEST_CASE("a segment without length and a triangle without area are named with their coordinates") {
  auto surface = two_triangles();
  surface.segments.push_back({2, 2});
  CHECK(only_fault(surface) == "segment 1 (nodes 2 and 2) has no length at (1, 1, 0) m");
  surface = two_triangles();
  surface.positions.insert(surface.positions.end(), {3, 0, 0});
  surface.triangles.push_back({1, 0, 4});
  CHECK(only_fault(surface) == "triangle 2 (nodes 1, 0, 4) has no area at (1.33333, 0, 0) m");
}

TEST_CASE("a triangle turned over against its neighbour is found") {
  auto surface = two_triangles();
  std::swap(surface.triangles[1][0], surface.triangles[1][1]);
  CHECK(only_fault(surface) ==
        "triangle 1 is turned over against its neighbour across the edge of nodes 0 and 2 at (0, 0, 0) m");
}

TEST_CASE("a cell that is there twice is a fault, whichever way it is turned") {
  mesh::Surface surface{.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0},
                        .segments = {{0, 1}, {1, 2}, {1, 0}},
                        .triangles = {{0, 1, 2}, {2, 1, 0}}};
  const auto found = mesh::faults(surface);
  REQUIRE(found.size() == 2);
  CHECK(found[0].rfind("segment 2 has the same corners as segment 0", 0) == 0);
  CHECK(found[1].rfind("triangle 1 has the same corners as triangle 0", 0) == 0);
}

TEST_CASE("a position that is not finite is a fault") {
  auto surface = two_triangles();
  surface.positions[4] = std::numeric_limits<double>::quiet_NaN();
  CHECK(only_fault(surface) == "node 1 at (1, nan, 0) m is not finite");
  surface = two_triangles();
  surface.positions.pop_back();
  CHECK(mesh::faults(surface).front() == "has 11 coordinates, which is no multiple of 3");
}

TEST_CASE("a part that reaches outside the cells is a fault") {
  auto surface = two_triangles();
  surface.parts[0].segment_end = 2;
  CHECK(only_fault(surface) == "part 'sheet' reaches outside the surface's cells");
}

TEST_CASE("no more than ten faults of a kind are written out") {
  auto surface = two_triangles();
  for (int i = 0; i < 25; ++i) surface.positions.insert(surface.positions.end(), {2.0 + i, 0, 0});
  const auto found = mesh::faults(surface);
  REQUIRE(found.size() == 11);
  CHECK(found.back() == "... and 15 more of this kind");
}

TEST_CASE("checking a bad surface throws an error headed by its name") {
  auto surface = two_triangles();
  surface.segments.push_back({3, 3});
  CHECK_THROWS_AS(mesh::check(surface, "structure.parts.net"), core::ConfigError);
  CHECK_THROWS_WITH(
      mesh::check(surface, "structure.parts.net"),
      Catch::Contains("structure.parts.net") && Catch::Contains("segment 1 (nodes 3 and 3) has no length"));
  CHECK_NOTHROW(mesh::check(two_triangles(), "structure.parts.net"));
}
