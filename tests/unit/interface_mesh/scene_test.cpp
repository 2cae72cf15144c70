#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "interface_mesh/points.hpp"
#include "interface_mesh/scene/nets.hpp"
#include "interface_mesh/scene/sheet.hpp"
#include "tests/support/scenes.hpp"

using namespace talus;
using core::Vector3;
using mesh::SheetScene;
using mesh::SquareNetScene;
using test::complaints_about;

TEST_CASE("the square net of the cable-net scene is read with its units and has 441 nodes") {
  SquareNetScene scene;
  CHECK(complaints_about("section: {corner: [0 m, 0 m, 0 m], size: [3 m, 3 m], pitch: 15 cm}", scene) == "");
  const auto net = mesh::generate(scene);
  CHECK(net.surface.node_count() == 441);
  CHECK(mesh::point(net.surface.positions, 220) == Vector3(1.5, 1.5, 0));
}

TEST_CASE("a net can stand upright") {
  SquareNetScene scene;
  CHECK(complaints_about(
            "section: {corner: [1, 2, 3], size: [2, 4], pitch: 1, along: [0, 3, 0], across: [0, 0, 1]}",
            scene) == "");
  const auto net = mesh::generate(scene);
  CHECK(mesh::point(net.surface.positions, net.surface.node_count() - 1) == Vector3(1, 4, 7));
}

TEST_CASE("a pitch that does not divide the size is told with the number of openings it gives") {
  CHECK(complaints_about<SquareNetScene>("section: {corner: [0, 0, 0], size: [3, 3.1], pitch: 0.15}") ==
        "scene.yaml:1:53: section.pitch: must divide the size: 3.1 m is 20.6667 times 0.15 m");
}

TEST_CASE("a panel is a rectangle or an outline, complete and not both") {
  CHECK(complaints_about<SheetScene>("section: {element_size: 1}") ==
        "scene.yaml:1:1: section: needs `corner` and `size`, or `outline`: where is it?");
  CHECK(complaints_about<SheetScene>("section: {element_size: 1, corner: [0, 0, 0]}") ==
        "scene.yaml:1:1: section: needs `corner` and `size`, or `outline`: where is it?");
  CHECK(complaints_about<SheetScene>("section: {element_size: 1, corner: [0, 0, 0], size: [1, 2, 3]}") ==
        "scene.yaml:1:53: section.size: needs two lengths, but has 3");
  CHECK(
      complaints_about<SheetScene>("section: {element_size: 1, corner: [0, 0, 0], size: [1, 2], outline: "
                                   "[[0, 0, 0], [1, 0, 0], [0, 1, 0]]}") ==
      "scene.yaml:1:70: section.outline: contradicts corner, size, along and across, which make a rectangle");
  CHECK(complaints_about<SheetScene>(
            "section: {element_size: 1, corner: [0, 0, 0], size: [1, 2], along: [0, 2, 0]}") ==
        "scene.yaml:1:68: section.along: must make a right angle with the other edge's direction");
}

TEST_CASE("an outline that crosses itself or is not flat is told with the coordinates") {
  CHECK(complaints_about<SheetScene>(
            "section: {element_size: 1, outline: [[0, 0, 1], [2, 2, 1], [2.5, 0, 1], [0, 2, 1]]}") ==
        "scene.yaml:1:37: section.outline: crosses or touches itself: edge 1 from (0, 0, 1) m to (2, 2, 1) m "
        "and edge 3 "
        "from (2.5, 0, 1) m to (0, 2, 1) m");
  // A bow tie whose halves cancel has no area vector; it crosses itself all the same, and no corner is
  // repeated.
  CHECK(complaints_about<SheetScene>(
            "section: {element_size: 1, outline: [[0, 0, 1], [2, 2, 1], [2, 0, 1], [0, 2, 1]]}") ==
        "scene.yaml:1:37: section.outline: crosses or touches itself: edge 1 from (0, 0, 1) m to (2, 2, 1) m "
        "and edge 3 "
        "from (2, 0, 1) m to (0, 2, 1) m");
  // The fitted plane rises by 0.1 m a metre along x and y: the corners are 0.1 m / sqrt(1.02) off it.
  CHECK(complaints_about<SheetScene>(
            "section: {element_size: 1, outline: [[0, 0, 0], [2, 0, 0], [2, 2, 0.4], [0, 2, 0]]}")
            .find("section.outline: must be flat, but its corners are up to 0.0990148 m") !=
        std::string::npos);
  CHECK(complaints_about<SheetScene>("section: {element_size: 1, outline: [[0, 0, 0], [2, 0, 0]]}") ==
        "scene.yaml:1:37: section.outline: needs at least 3 corners, but has 2");
}

TEST_CASE("edge nodes off the outline or at one place are told with their coordinates") {
  const std::string start = "section: {element_size: 0.5, corner: [0, 0, 0], size: [3, 2], edge_nodes: ";
  CHECK(complaints_about<SheetScene>(start + "[[1, 0, 0], [1, 0.1, 0]]}")
            .find("section.edge_nodes: must lie on the outline, but (1, 0.1, 0) m is 0.1 m away from it") !=
        std::string::npos);
  CHECK(complaints_about<SheetScene>(start + "[[1, 0, 0.25]]}").find("is 0.25 m away") != std::string::npos);
  CHECK(complaints_about<SheetScene>(start + "[[1, 0, 0], [1, 0, 0]]}").find("names (1, 0, 0) m twice") !=
        std::string::npos);
  SheetScene scene;
  CHECK(complaints_about(start + "[[1.1, 0, 0]]}", scene) == "");
  // 1.1 m and 1.9 m at 0.5 m: 2 and 4 parts.
  CHECK(mesh::generate(scene).find_set("edge_south")->nodes.size() == 7);
}

TEST_CASE("a chain-link net given by its opening and mesh angle has that opening") {
  mesh::RhombicNetScene scene;
  CHECK(complaints_about(
            "section: {corner: [0, 0, 0], size: [1, 1], opening: 65 mm, angle: 60 deg, wire_diameter: 3 mm}",
            scene) == "");
  CHECK(mesh::opening(scene.pattern()) == Approx(0.065).epsilon(1e-12));
  CHECK(std::atan2(scene.pattern().diagonals[0], scene.pattern().diagonals[1]) ==
        Approx(std::numbers::pi / 6).epsilon(1e-12));
  CHECK_FALSE(mesh::generate(scene).surface.segments.empty());
}

TEST_CASE("a chain-link net without or with contradictory mesh sizes is refused") {
  const std::string start = "section: {corner: [0, 0, 0], size: [1, 1], wire_diameter: 3 mm";
  const std::string complaint =
      "scene.yaml:1:59: section.wire_diameter: needs `diagonals`, or `opening` and `angle`, beside it: how "
      "large are the "
      "meshes?";
  for (const std::string keys :
       {"", ", opening: 1 mm", ", diagonals: [1, 2], opening: 1, angle: 1", ", diagonals: [1, 2], angle: 1"})
    CHECK(complaints_about<mesh::RhombicNetScene>(start + keys + "}") == complaint);
  CHECK(complaints_about<mesh::RhombicNetScene>(start + ", diagonals: [1 mm, 1 mm]}")
            .find("leaves no opening between the wires") != std::string::npos);
  CHECK(complaints_about<mesh::RhombicNetScene>(start + ", diagonals: [1 m]}")
            .find("needs two lengths, but has 1") != std::string::npos);
}

TEST_CASE("double-twist and ring nets are read from data-sheet values, and impossible ones refused") {
  mesh::HexagonalNetScene twisted;
  const std::string panel = "section: {corner: [0, 0, 0], size: [2, 2], ";
  CHECK(complaints_about(panel + "mesh_size: [80 mm, 100 mm], twist_length: 40 mm, wire_diameter: 2.7 mm}",
                         twisted) == "");
  CHECK(mesh::generate(twisted).surface.parts.size() == 2);
  CHECK(complaints_about<mesh::HexagonalNetScene>(
            panel + "mesh_size: [80 mm, 100 mm], twist_length: 120 mm, wire_diameter: 2.7 mm}")
            .find("twist_length: must be less than the length of an opening, 0.1 m") != std::string::npos);
  mesh::RingNetScene rings;
  CHECK(complaints_about(panel + "inner_diameter: 300 mm, windings: 12, wire_diameter: 3 mm}", rings) == "");
  CHECK(mesh::generate(rings).surface.parts[0].wire_radius == Approx(rings.pattern().bundle_diameter() / 2));
  CHECK(complaints_about<mesh::RingNetScene>(panel +
                                             "inner_diameter: 300 mm, windings: 12, wire_diameter: 30 mm}")
            .find("on rings touch across the corner") != std::string::npos);
}

TEST_CASE("a net of more segments than can be meant is refused before it is made") {
  CHECK(complaints_about<mesh::RingNetScene>("section: {corner: [0, 0, 0], size: [3 km, 3 km], "
                                             "inner_diameter: 300 mm, windings: 12, wire_diameter: 3 mm}")
            .find("are the units right?") != std::string::npos);
}

TEST_CASE("a square net is clipped to an outline that is no rectangle") {
  SquareNetScene scene;
  CHECK(complaints_about("section: {outline: [[0, 0, 0], [2, 0, 0], [0, 2, 0]], pitch: 0.5}", scene) == "");
  const auto net = mesh::generate(scene);
  // Wires at 0, 0.5, 1, 1.5 of lengths 2, 1.5, 1, 0.5 each way.
  double length = 0;
  for (const auto& [a, b] : net.surface.segments)
    length += (mesh::point(net.surface.positions, b) - mesh::point(net.surface.positions, a)).norm();
  CHECK(length == Approx(10).epsilon(1e-12));
}

TEST_CASE("an element size that would make too many triangles is refused before they are made") {
  CHECK(complaints_about<SheetScene>("section: {element_size: 1 um, corner: [0, 0, 0], size: [3, 2]}")
            .find("gives about 1e+13 triangles") != std::string::npos);
}

TEST_CASE("cells cut by both diagonals must divide a rectangle, and exclude every other way of dividing it") {
  const std::string start = "section: {corner: [0, 0, 0], size: [3, 2], crossed_cell: ";
  SheetScene scene;
  CHECK(complaints_about(start + "[0.3, 0.5]}", scene) == "");
  CHECK(mesh::generate(scene).surface.triangles.size() == 4 * 10 * 4);
  CHECK(complaints_about<SheetScene>(start + "[0.3, 0.45]}") ==
        "scene.yaml:1:58: section.crossed_cell: must divide the size along and across");
  CHECK(complaints_about<SheetScene>(start + "[0.3]}")
            .find("section.crossed_cell: needs two lengths, but has 1") != std::string::npos);
  CHECK(complaints_about<SheetScene>(start + "[0.3, 0.5], element_size: 1}")
            .find("section.crossed_cell: contradicts element_size") != std::string::npos);
  CHECK(complaints_about<SheetScene>("section: {corner: [0, 0, 0], size: [3, 2]}")
            .find("section: needs `element_size` or `crossed_cell`: how large are the triangles?") !=
        std::string::npos);
}
