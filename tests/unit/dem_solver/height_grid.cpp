#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/errors.hpp"
#include "dem_solver/scene/boundary_scene.hpp"
#include "tests/support/folder.hpp"

using namespace talus;

namespace {

const std::string header = "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\nNODATA_value -1\n";

mesh::Surface surface_of(const std::string& text, const core::Vector3& origin = core::Vector3::Zero()) {
  test::Folder folder("height_grid");
  folder.add("slope.asc", text);
  dem::BoundaryScene boundary;
  boundary.shape = dem::HeightGridScene{.path = folder / "slope.asc", .origin = origin};
  return dem::make_surface({{"slope", boundary}});
}

core::Vector3 node(const mesh::Surface& surface, std::size_t k) {
  return {surface.positions[3 * k], surface.positions[3 * k + 1], surface.positions[3 * k + 2]};
}

}  // namespace

TEST_CASE("The rows of a height grid run from north to south, its heights stand at the middles of cells") {
  const mesh::Surface surface = surface_of(header + "7 8 9\n1 2 3\n", {100, 200, 0.5});
  REQUIRE(surface.node_count() == 6);
  REQUIRE(surface.triangles.size() == 4);
  const double expected[2][3] = {{1, 2, 3}, {7, 8, 9}};  // southern row first
  for (std::size_t k = 0; k < 6; ++k) {
    const core::Vector3 p = node(surface, k) - core::Vector3(5, 5, -0.5);
    REQUIRE((p.x() >= 0 && p.x() <= 20 && p.y() >= 0 && p.y() <= 10));
    CHECK(p.z() == expected[std::lround(p.y() / 10)][std::lround(p.x() / 10)]);
  }
}

TEST_CASE("Every triangle of a height grid faces upwards") {
  const mesh::Surface surface = surface_of(header + "7 -8 9\n1 12 3\n");
  for (const auto& [a, b, c] : surface.triangles)
    CHECK((node(surface, b) - node(surface, a)).cross(node(surface, c) - node(surface, a)).z() > 0);
}

TEST_CASE("A cell of a height grid is cut along its less steep diagonal") {
  const mesh::Surface level_to_the_south_east = surface_of(header + "0 5 9\n1 0 9\n");
  for (const auto& triangle : {level_to_the_south_east.triangles[0], level_to_the_south_east.triangles[1]}) {
    int low = 0;
    for (const mesh::Index k : triangle) low += node(level_to_the_south_east, k).z() == 0;
    CHECK(low == 2);
  }
}

TEST_CASE("Where heights are missing a height grid has a hole") {
  const mesh::Surface surface = surface_of(header + "7 8 9\n-1 2 3\n");
  CHECK(surface.node_count() == 4);
  CHECK(surface.triangles.size() == 2);
}

TEST_CASE("Files that are no height grids are refused with what they lack") {
  using Catch::Contains;
  CHECK_THROWS_WITH(surface_of(header + "1 2 3\n4 5\n"), Contains("has 5 heights") && Contains("is 6"));
  CHECK_THROWS_WITH(surface_of(header + "1 2 3\n4 five 6\n"), Contains("height 5 is not a number"));
  CHECK_THROWS_WITH(surface_of("ncols 3\nnrows 2\n1 2 3 4 5 6\n"), Contains("no `cellsize`"));
  CHECK_THROWS_WITH(surface_of("ncols 1\nnrows 2\n1 2\n"),
                    Contains("`ncols` must be a whole number of at least 2"));
  CHECK_THROWS_WITH(surface_of("ncols many\n"), Contains("`ncols` needs a number"));
  CHECK_THROWS_WITH(surface_of(header + "-1 2 3\n4 -1 6\n"), Contains("no four neighbours"));
  CHECK_THROWS_AS(dem::height_grid({.path = "/nowhere/slope.asc"}), core::ConfigError);
}
