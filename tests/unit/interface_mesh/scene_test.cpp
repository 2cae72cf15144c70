#include <catch2/catch.hpp>

#include "interface_mesh/points.hpp"
#include "interface_mesh/scene/sheet.hpp"
#include "interface_mesh/scene/square_net.hpp"
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

TEST_CASE("an element size that would make too many triangles is refused before they are made") {
  CHECK(complaints_about<SheetScene>("section: {element_size: 1 um, corner: [0, 0, 0], size: [3, 2]}")
            .find("gives about 1e+13 triangles") != std::string::npos);
}
