#include <Eigen/Geometry>
#include <algorithm>
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

TEST_CASE("Dialects of height grids are read as the same grid") {
  const std::string rows = "7 8 9\n1 2 3\n";
  const std::vector<double> expected = surface_of(header + rows).positions;
  const std::string plain = "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\n";
  std::string windows = header + rows, mac = windows;
  for (std::size_t at = 0; (at = windows.find('\n', at)) != std::string::npos; at += 2)
    windows.replace(at, 1, "\r\n");
  std::ranges::replace(mac, '\n', '\r');
  for (const std::string& text :
       {plain + "dx 10\ndy 10\n" + rows, plain + "cellsize 10\nNODATA -1\n" + rows,
        "NCOLS 3\nNROWS 2\nXLLCORNER 100\nYLLCORNER 200\nCELLSIZE 1e1\n" + rows,
        "ncols 3\nnrows 2\nxllcenter 105\nyllcenter 205\ncellsize 10\n" + rows,
        "ncols 3\nnrows 2\nXllCenter 105\nyllcorner +200\ncellsize 10\n" + rows,
        "\xef\xbb\xbf" + header + rows, windows, mac, header + "\t7.0  8.0e0\n9\n1 2 3\n\n"})
    CHECK(surface_of(text).positions == expected);
}

TEST_CASE("A height grid may have cells wider than long") {
  const mesh::Surface surface =
      surface_of("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ndx 2\ndy 6\n7 8 9\n1 2 3\n");
  double east = 0, north = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    east = std::max(east, node(surface, k).x());
    north = std::max(north, node(surface, k).y());
  }
  CHECK(east == 5);   // the middle of the third cell of 2 m
  CHECK(north == 9);  // the middle of the second cell of 6 m
}

TEST_CASE("Missing heights leave a hole in whatever way the grid writes them") {
  const std::string shape = "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n";
  for (const auto& [declared, written] : {std::pair{"", "nan"},
                                          {"", "NaN"},
                                          {"", "-nan"},
                                          {"", "NA"},
                                          {"", "1.#QNAN"},
                                          {"", "-9999"},
                                          {"", "-9999.000"},
                                          {"NODATA_value nan\n", "nan"},
                                          {"NODATA_value -32768\n", "-32768"},
                                          {"nodata_value -3.4028230607370965e+38\n", "-3.40282306e+38"},
                                          {"NODATA_value -3.40282e+38\n", "-3.4028234663852886e+38"},
                                          {"NODATA_value 1.70141e38\n", "1.70141183e+38"}}) {
    INFO(declared << written);
    const mesh::Surface surface = surface_of(shape + declared + written + " 8 9\n1 2 3\n");
    CHECK(surface.node_count() == 4);
    CHECK(surface.triangles.size() == 2);
  }
}

TEST_CASE("Heights that cannot be meant are refused with value, place and line") {
  using Catch::Contains;
  const std::string shape = "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 2\n";
  for (const char* undeclared : {"-32768", "-32767", "32767", "65535", "-99999", "-3.4028235e38", "1e20"})
    CHECK_THROWS_WITH(surface_of(shape + "7 8 9\n1 " + undeclared + " 3\n"),
                      Contains("slope.asc:7: the height ") && Contains("in row 2, column 2, at (3, 1)") &&
                          Contains("add the header line `NODATA_value"));
  CHECK_THROWS_WITH(surface_of(shape + "NODATA_value -1\n7 -9999 9\n1 2 3\n"),
                    Contains("slope.asc:7: the height -9999 in row 1, column 2"));
  // Values that could be heights, among others far away.
  for (const char* undeclared : {"0", "-999"})
    CHECK_THROWS_WITH(surface_of(shape + "1507 1508 1509\n1501 1502 " + undeclared + "\n"),
                      Contains("slope.asc:7: the height ") && Contains("in row 2, column 3, at (5, 1)") &&
                          Contains("from all others, which are within 8 m"));
  CHECK_NOTHROW(surface_of(shape + "0 300 600\n0 300 600\n"));  // a wall of 300 m over 2 m, but no void
}

TEST_CASE("A map in degrees is refused, a small map in metres is not") {
  using Catch::Contains;
  const auto grid = [](const std::string& corner, const std::string& cell, const std::string& heights) {
    return surface_of("ncols 3\nnrows 2\n" + corner + "cellsize " + cell + "\n" + heights);
  };
  const std::string alps = "xllcorner 7.1\nyllcorner 46.2\n", hilly = "1000 1040 1090\n1010 1050 1100\n",
                    flat = "412 412 412\n412 412 412\n";
  CHECK_THROWS_WITH(grid(alps, "0.000277777778", hilly),
                    Contains("looks like degrees") && Contains("project it to metres"));
  CHECK_THROWS_WITH(grid(alps, "0.000277777778", flat), Contains("looks like degrees"));
  CHECK_THROWS_WITH(grid("xllcorner -122.5\nyllcorner 37.7\n", "0.00833", hilly),
                    Contains("looks like degrees"));
  CHECK_NOTHROW(grid("xllcorner 0\nyllcorner 0\n", "0.01", "0 0.01 0.02\n0.01 0.02 0.03\n"));  // a chute
  CHECK_NOTHROW(grid("xllcorner 2600000\nyllcorner 1200000\n", "0.05", flat));
  CHECK_NOTHROW(grid(alps, "10", hilly));
}

TEST_CASE("Decimal commas, unknown keys and contradictions in a height grid are refused with their line") {
  using Catch::Contains;
  const std::string shape = "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\n", rows = "7 8 9\n1 2 3\n";
  CHECK_THROWS_WITH(surface_of(header + "7 8 9\n1,5 2 3\n"),
                    Contains("slope.asc:8: height 4 is not a number: '1,5'; decimals need a point"));
  CHECK_THROWS_WITH(surface_of(shape + "cellsize 2,5\n" + rows),
                    Contains("slope.asc:5: the header's `cellsize` needs a number, not '2,5'; decimals"));
  CHECK_THROWS_WITH(surface_of(header + "7 8 9\n1 2 inf\n"),
                    Contains("slope.asc:8: height 6 is not a number: 'inf'"));
  CHECK_THROWS_WITH(surface_of("DSAA\n3 2\n" + rows), Contains("slope.asc:1: `DSAA` is no key"));
  CHECK_THROWS_WITH(surface_of(shape + "cellsize 2 2\n" + rows),
                    Contains("slope.asc:5:") && Contains("one number"));
  CHECK_THROWS_WITH(surface_of(shape + "cellsize\n" + rows),
                    Contains("slope.asc:5:") && Contains("needs a number"));
  CHECK_THROWS_WITH(surface_of(shape + "cellsize 2\nncols 4\n" + rows),
                    Contains("slope.asc:6:") && Contains("twice"));
  CHECK_THROWS_WITH(surface_of(shape + "cellsize 2\ndx 3\n" + rows),
                    Contains("slope.asc:6: `dx` contradicts `cellsize`"));
  CHECK_THROWS_WITH(surface_of(shape + "cellsize 2\nxllcenter 3\n" + rows),
                    Contains("contradicts `xllcorner`"));
  CHECK_THROWS_WITH(surface_of(shape + "cellsize -2\n" + rows),
                    Contains("slope.asc:5:") && Contains("greater than 0"));
  CHECK_THROWS_WITH(surface_of("ncols 30000\nnrows 30000\nxllcorner 0\nyllcorner 0\ncellsize 2\n" + rows),
                    Contains("has 6 heights, but `ncols` times `nrows` is 900000000"));
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
