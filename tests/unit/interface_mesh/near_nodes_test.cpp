#include "interface_mesh/near_nodes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/errors.hpp"
#include "interface_mesh/points.hpp"
#include "interface_mesh/scene/mesh_file.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/scenes.hpp"

using namespace talus;
using core::Vector3;
using mesh::Index;

namespace {

/// Two triangles that meet along an edge whose nodes are there twice, `gap` apart.
mesh::Net torn_sheet(double gap) {
  mesh::Net net;
  net.surface = {.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1 + gap, 0, 0, 1, 1, 0, 0, 1, gap},
                 .triangles = {{0, 1, 2}, {3, 4, 5}},
                 .parts = {{.name = "sheet", .triangle_end = 2}}};
  net.node_sets = {{"nodes", {0, 1, 2, 3, 4, 5}}};
  return net;
}

}  // namespace

TEST_CASE("nodes of open rims that are nearly equal are found with their distance, others are not") {
  const auto pairs = mesh::nearly_joined(torn_sheet(1e-6).surface);
  REQUIRE(pairs.size() == 2);
  CHECK((pairs[0].first == 1 && pairs[0].second == 3));
  CHECK(pairs[0].distance == Approx(1e-6).epsilon(1e-6));
  CHECK((pairs[1].first == 2 && pairs[1].second == 5));
  CHECK(mesh::nearly_joined(torn_sheet(2e-3).surface).empty());
  CHECK(mesh::nearly_joined(torn_sheet(0).surface).size() == 2);
}

TEST_CASE("what is near is measured by the edges beside it, at every size of the mesh") {
  for (const double size : {1e-6, 1.0, 1e6})
    for (const double gap : {1e-6, 2e-3}) {
      auto surface = torn_sheet(gap).surface;
      for (double& coordinate : surface.positions) coordinate *= size;
      CHECK(mesh::nearly_joined(surface).size() == (gap < 1e-3 ? 2 : 0));
    }
}

TEST_CASE("nodes in the middle of ropes or sheets are found like those of rims and ends") {
  // Two ropes that cross in their middles, a ten-millionth apart; a sheet of four triangles, above whose middle a line
  // ends.
  mesh::Surface surface{
      .positions = {-1, 0, 0, 0, 0, 0, 1, 0, 0, 0, -1,  0,   0, 0,   1e-7, 0,    1,   0,   5, 0,
                    0,  6, 0, 0, 6, 1, 0, 5, 1, 0, 5.5, 0.5, 0, 5.5, 0.5,  1e-6, 5.5, 0.5, 1},
      .segments = {{0, 1}, {1, 2}, {3, 4}, {4, 5}, {11, 12}},
      .triangles = {{6, 7, 10}, {7, 8, 10}, {8, 9, 10}, {9, 6, 10}}};
  const auto pairs = mesh::nearly_joined(surface);
  REQUIRE(pairs.size() == 2);
  CHECK((pairs[0].first == 1 && pairs[0].second == 4));
  CHECK((pairs[1].first == 10 && pairs[1].second == 11));
}

TEST_CASE("a node that lies on an edge it is no end of tears a mesh, one beside it does not") {
  // A triangle, and two that share its long side but divide it; a rope that ends in the middle of another's segment.
  const auto found = [](double off) {
    const mesh::Surface surface{.positions = {0, 0, 0, 2, 0, 0, 1, 1,   0,   1, -off, 0, 1, -1,
                                              0, 5, 0, 0, 7, 0, 0, 6.2, off, 0, 6.2,  1, 0},
                                .segments = {{5, 6}, {7, 8}},
                                .triangles = {{0, 1, 2}, {0, 4, 3}, {3, 4, 1}}};
    return mesh::nodes_on_edges(surface);
  };
  for (const double off : {0.0, 9e-4}) {
    const auto nodes = found(off);
    REQUIRE(nodes.size() == 2);
    CHECK((nodes[0].node == 3 && nodes[0].edge == std::array<Index, 2>{0, 1}));
    CHECK((nodes[1].node == 7 && nodes[1].edge == std::array<Index, 2>{5, 6}));
  }
  CHECK(found(2.1e-3).empty());
}

TEST_CASE("nearly equal nodes are those that a comparison of all pairs finds") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1), decade(-5, 0);
  mesh::Surface surface;
  std::vector<double> length;
  for (int k = 0; k < 600; ++k) {
    const Vector3 at(place(random), place(random), place(random));
    const double size = std::pow(10, decade(random));
    // Every other line starts near the one before it, by more or less than a thousandth of its length.
    const Vector3 start = k % 2
                              ? Vector3(mesh::point(surface.positions, surface.node_count() - 2) +
                                        1.5e-3 * size * Vector3(place(random), place(random), place(random)))
                              : at;
    mesh::append(surface.positions, start);
    mesh::append(surface.positions, start + Vector3(size, 0, 0));
    surface.segments.push_back({2 * k, 2 * k + 1});
    length.insert(length.end(), 2, size);
  }
  std::size_t expected = 0;
  for (Index a = 0; a < surface.node_count(); ++a)
    for (Index b = 0; b < a; ++b) {
      const double distance = (mesh::point(surface.positions, a) - mesh::point(surface.positions, b)).norm();
      expected += distance <=
                  1e-3 * std::min(length[static_cast<std::size_t>(a)], length[static_cast<std::size_t>(b)]);
    }
  CHECK(expected > 20);
  CHECK(mesh::nearly_joined(surface).size() == expected);
}

TEST_CASE("a tolerance joins a torn sheet and nothing that is further apart") {
  const auto joined = mesh::join_near_nodes(torn_sheet(1e-6), 2e-6, "sheet.stl");
  CHECK(joined.surface.node_count() == 4);
  CHECK(joined.surface.triangles == std::vector<std::array<Index, 3>>{{0, 1, 2}, {1, 3, 2}});
  CHECK(joined.node_sets[0].nodes == std::vector<Index>{0, 1, 2, 3});
  CHECK(mesh::join_near_nodes(torn_sheet(1e-6), 5e-7, "sheet.stl").surface.node_count() == 6);
  CHECK(mesh::join_near_nodes(torn_sheet(0), 0, "sheet.stl").surface.node_count() == 4);
  CHECK_THROWS_WITH(mesh::join_near_nodes(torn_sheet(1e-6), 1.1, "sheet.stl"),
                    Catch::Contains("sheet.stl: `join` of 1.1 m would join both ends of an edge"));
}

TEST_CASE("a scene is told of nearly equal nodes with their distance, and decides itself") {
  test::Folder folder("near_nodes");
  folder.add("sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1.0000001 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n");
  const auto nodes = [&](const std::string& more) {
    mesh::MeshFileScene scene;
    CHECK(test::complaints_about("section: {path: " + (folder / "sheet.obj").string() + more + "}", scene) ==
          "");
    return mesh::generate(scene).surface.node_count();
  };
  CHECK_THROWS_WITH(nodes(""),
                    Catch::Contains("sheet.obj: 1 pair(s) of nodes are nearly at the same place") &&
                        Catch::Contains("by 1e-07 m: nodes 1 and 3 at (1, 0, 0) m") &&
                        Catch::Contains("`join: 2e-07 m` joins them, `join: 0 m` leaves them apart"));
  CHECK(nodes(", join: 2e-7 m") == 4);
  CHECK(nodes(", join: 0 m") == 5);
  CHECK(nodes(", unit: 1 mm, join: 2e-10 m") == 4);
}

TEST_CASE("the origin of a file in map coordinates is taken off before anything is rounded") {
  test::Folder folder("origin");
  folder.add("map.obj",
             "v 2600000.4 1200000.123 1500.08\nv 2600001 1200000 1500\nv 2600000 1200001 1500\nf 1 2 3\n");
  mesh::MeshFileScene scene;
  CHECK(test::complaints_about(
            "section: {path: " + (folder / "map.obj").string() + ", origin: [2600000 m, 1200 km, 1500]}",
            scene) == "");
  const auto net = mesh::generate(scene);
  CHECK(mesh::point(net.surface.positions, 0) ==
        Vector3(2600000.4 - 2600000, 1200000.123 - 1200000, 1500.08 - 1500));
  CHECK(mesh::point(net.surface.positions, 1) == Vector3(1, 0, 0));
}
