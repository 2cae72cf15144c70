#include <catch2/catch.hpp>
#include <fstream>
#include <numbers>

#include "core/errors.hpp"
#include "dem_solver/boundary/closest_point.hpp"
#include "dem_solver/rocks/closed_surface.hpp"
#include "dem_solver/rocks/inner_grid.hpp"
#include "dem_solver/rocks/polyhedron.hpp"
#include "dem_solver/rocks/sphere_filling.hpp"
#include "dem_solver/rocks/triangle_tree.hpp"
#include "dem_solver/scene/rock_scene.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/rock_surfaces.hpp"

using namespace talus;
using namespace talus::dem;
using Catch::Contains;
using core::Vector3;
using test::moved;
using test::node_of;
using test::together;
using test::turned_over;

namespace {

Triple<double> triple(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

/// The solid angles of the triangles add up to 4 pi inside of a closed surface and to 0 outside (van Oosterom
/// and Strackee 1983).
bool is_inside(const mesh::Surface& surface, const Vector3& p) {
  double sum = 0;
  for (const auto& [ia, ib, ic] : surface.triangles) {
    const Vector3 a = node_of(surface, ia) - p, b = node_of(surface, ib) - p, c = node_of(surface, ic) - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum > 2 * std::numbers::pi;
}

double distance(const mesh::Surface& surface, const Vector3& at) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [ia, ib, ic] : surface.triangles) {
    const Triple<double> p = triple(at), a = triple(node_of(surface, ia)), b = triple(node_of(surface, ib)),
                         c = triple(node_of(surface, ic));
    const Weights w = closest_on_triangle(p, a, b, c);
    nearest = std::min(nearest, length(w.a * (a - p) + w.b * (b - p) + w.c * (c - p)));
  }
  return nearest;
}

mesh::Surface cube() {
  return make_block({.edge = 1, .cut = 0.25});
}

std::string obj_of(const mesh::Surface& surface) {
  std::ostringstream text;
  text.precision(17);
  for (mesh::Index node = 0; node < surface.node_count(); ++node)
    text << "v " << node_of(surface, node).transpose() << '\n';
  for (const auto& [a, b, c] : surface.triangles)
    text << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  return text.str();
}

BuiltRock built_from(const mesh::Surface& surface, double deviation,
                     const Vector3& origin = Vector3::Zero()) {
  test::Folder folder("rock_surfaces");
  folder.add("rock.obj", obj_of(surface));
  SurfaceScene from_file;
  from_file.file.path = folder / "rock.obj";
  from_file.file.origin = origin;
  from_file.deviation = deviation;
  RockScene scene;
  scene.shape = from_file;
  return build_rock("rock", scene, 2600);
}

}  // namespace

TEST_CASE("the tree's distance to a surface has the bits of a search through all triangles") {
  const mesh::Surface rock = test::rock_surface(3);
  const TriangleTree tree(rock);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::int32_t hint = 0;
  for (int query = 0; query < 500; ++query) {
    const Vector3 p(coordinate(random), coordinate(random), coordinate(random));
    REQUIRE(tree.distance(triple(p), hint) == distance(rock, p));
  }
}

TEST_CASE("a grid point is inside of a rock where the solid angle of the surface says so") {
  const mesh::Surface rock = test::rock_surface(2);
  const PointGrid grid = grid_over(rock, 0.11);
  const InnerColumns columns(rock, grid);
  int inside = 0;
  for (int i = 0; i <= grid.steps[0]; ++i)
    for (int j = 0; j <= grid.steps[1]; ++j)
      for (int k = 0; k <= grid.steps[2]; ++k) {
        const Vector3 p = grid.point(i, j, k);
        REQUIRE(columns.contains(i, j, p.z()) == is_inside(rock, p));
        inside += is_inside(rock, p);
      }
  CHECK(inside > 50);
}

TEST_CASE("lines through edges and corners of a surface enter it as often as they leave it") {
  // Every column of these grids meets edges or corners: diagonals of faces, upright faces, twelve corners.
  for (const Vector3& place :
       {Vector3(0, 0, 0), Vector3(0.1, 1.0 / 3, -0.7), Vector3(2600000.1, 1200000.7, 1500.3)}) {
    const mesh::Surface block = moved(cube(), place);
    const PointGrid grid = grid_over(block, 0.125);
    const InnerColumns columns(block, grid);
    for (int i = 0; i <= grid.steps[0]; ++i)
      for (int j = 0; j <= grid.steps[1]; ++j)
        for (int k = 0; k <= grid.steps[2]; ++k) {
          const Vector3 p = grid.point(i, j, k);
          if (distance(block, p) < 1e-6) continue;
          REQUIRE(columns.contains(i, j, p.z()) == is_inside(block, p));
        }
  }
}

TEST_CASE("the side of a line is exact and never neither") {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> whole(-1000, 1000);
  for (int n = 0; n < 10'000; ++n) {
    // On a line of whole numbers by construction, then a thousandth of nothing beside it.
    const double x = whole(random), y = whole(random), dx = whole(random), dy = whole(random);
    if (dx == 0 && dy == 0) continue;
    const Place a{x, y}, b{x + 3 * dx, y + 3 * dy}, on{x + dx, y + dy};
    CHECK(side_of_line(a, b, on) == -side_of_line(b, a, on));
    CHECK(side_of_line(a, b, on) != 0);
    const Place above{on.x, std::nextafter(on.y, 1e9)}, below{on.x, std::nextafter(on.y, -1e9)};
    if (dx == 0) continue;
    CHECK(side_of_line(a, b, above) == (dx > 0 ? 1 : -1));
    CHECK(side_of_line(a, b, below) == (dx > 0 ? -1 : 1));
  }
}

TEST_CASE("the same rock is filled with the same spheres in every unit of length") {
  for (const mesh::Surface& rock : {cube(), test::rock_surface(3)})
    for (const double deviation : {0.1, 0.05}) {
      const SphereFilling expected = fill_with_spheres(rock, {.deviation = deviation});
      for (const double scale : {1e-3, 0.3048, 1e3, 1e6}) {
        const SphereFilling filling =
            fill_with_spheres(moved(rock, Vector3::Zero(), scale), {.deviation = deviation * scale});
        REQUIRE(filling.balls.size() == expected.balls.size());
        for (std::size_t n = 0; n < filling.balls.size(); ++n)
          REQUIRE((filling.balls[n].centre / scale - expected.balls[n].centre).norm() < 1e-9);
        CHECK(filling.deviation / scale == Approx(expected.deviation).epsilon(1e-9));
      }
    }
}

TEST_CASE("a filling of eighty thousand facets stays as close as one of five hundred", "[long]") {
  const SphereFilling coarse = fill_with_spheres(test::rock_surface(3), {.deviation = 0.05});
  const mesh::Surface scanned = test::rock_surface(7);
  REQUIRE(scanned.triangles.size() > 80'000);
  REQUIRE(closed_surface_fault(scanned).empty());
  const SphereFilling fine = fill_with_spheres(scanned, {.deviation = 0.05});
  CHECK(fine.deviation < 0.05);
  CHECK(fine.balls.size() == Approx(coarse.balls.size()).epsilon(0.3));
}

TEST_CASE("a deviation of a two-hundredth of the rock is kept or refused, never made larger in silence") {
  mesh::Surface needle = test::sphere_surface(4);
  Eigen::Map<Eigen::Matrix3Xd> nodes(needle.positions.data(), 3, needle.node_count());
  nodes = (Vector3(0.5, 0.05, 0.05).asDiagonal() * nodes).eval();
  const double deviation = 0.005;
  const SphereFilling filling = fill_with_spheres(needle, {.deviation = deviation});
  // Of the grid of half the deviation some point is nearer than half its diagonal, and is filled: the sphere
  // around any other deep enough stands out by no more than the deviation and twice that way.
  const double most = (1 + std::sqrt(3.0) / 2) * deviation;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int sample = 0; sample < 300; ++sample) {
    const Vector3 p =
        Vector3(0.5, 0.05, 0.05).cwiseProduct(Vector3(part(random), part(random), part(random)));
    const double depth = distance(needle, p);
    if (!is_inside(needle, p) || depth < most) continue;
    double gap = 1;
    for (const Ball& ball : filling.balls) gap = std::min(gap, (p - ball.centre).norm() - ball.radius);
    REQUIRE(gap + depth < most);
  }
  CHECK_THROWS_WITH(fill_with_spheres(needle, {.deviation = 1e-4}),
                    Contains("grid points") && Contains("must be about 0.0"));
  CHECK(built_from(test::rock_surface(4), 0.05).deviation < 0.05);
}

TEST_CASE("a surface that is no rock is told apart by its kind of fault, with the place") {
  const mesh::Surface ball = test::sphere_surface(2), small = moved(ball, Vector3(0.01, 0.02, 0.03), 0.5);
  CHECK(closed_surface_fault(ball).empty());
  CHECK_THAT(closed_surface_fault(together(ball, turned_over(small))),
             Contains("holds a shell of 128 triangles inside, near (0."));
  CHECK_THAT(closed_surface_fault(together(small, ball)), Contains("holds a shell of 128 triangles inside"));
  CHECK_THAT(closed_surface_fault(together(moved(ball, Vector3(3, 0, 0), 0.5), ball)),
             Contains("is 2 separate bodies, one of 128 triangles near") && Contains("a rock of its own"));
  CHECK_THAT(closed_surface_fault(together(ball, moved(ball, Vector3(1.1, 0.03, 0.02)))),
             Contains("bodies that reach into each other: triangles"));
  CHECK_THAT(closed_surface_fault(turned_over(ball)), Contains("turned inside out"));
  mesh::Surface one_turned = ball;
  std::swap(one_turned.triangles[7][0], one_turned.triangles[7][1]);
  CHECK_THAT(closed_surface_fault(one_turned), Contains("one is turned over"));
  mesh::Surface open = ball;
  open.triangles.pop_back();
  CHECK_THAT(closed_surface_fault(open),
             Contains("is not closed: the edge from") && Contains("one triangle only"));
}

TEST_CASE("two bodies that share an edge, and a wall inside of a body, are told by the edge") {
  const auto tetrahedron = [](double z) {
    mesh::Surface surface;
    for (const Vector3& p : {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, z, z), Vector3(0, -z, z)})
      test::add_node(surface, p);
    surface.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return z > 0 ? turned_over(surface) : surface;
  };
  mesh::Surface touching = tetrahedron(1);
  for (const auto& [a, b, c] : tetrahedron(-1).triangles) {
    const auto own = [](mesh::Index node) { return node < 2 ? node : node + 2; };
    touching.triangles.push_back({own(a), own(b), own(c)});
  }
  const mesh::Surface lower = tetrahedron(-1);
  touching.positions.insert(touching.positions.end(), lower.positions.begin() + 6, lower.positions.end());
  CHECK_THAT(closed_surface_fault(touching),
             Contains("the edge from (0, 0, 0) m to (1, 0, 0) m belongs to 4 triangles"));
}

TEST_CASE(
    "a corner pushed through the other side makes a surface cross itself, though its triangles hang "
    "together") {
  mesh::Surface ball = test::sphere_surface(2);
  ball.positions[0] = -1.5;  // the corner at (1, 0, 0)
  ball.positions[1] = 0.013;
  CHECK_THAT(closed_surface_fault(ball), Contains("crosses itself: triangles"));
  // Two pyramids on a ring of five, one of whose corners is pushed through the far side: triangles that cross
  // share the tip.
  mesh::Surface pyramids;
  for (int k = 0; k < 5; ++k) {
    const double angle = 2 * std::numbers::pi * k / 5;
    test::add_node(pyramids, {std::cos(angle), std::sin(angle), 0});
    pyramids.triangles.insert(pyramids.triangles.end(), {{5, k, (k + 1) % 5}, {6, (k + 1) % 5, k}});
  }
  test::add_node(pyramids, {0, 0, 1});
  test::add_node(pyramids, {0, 0, -1});
  CHECK(closed_surface_fault(pyramids).empty());
  const double across = 2 * std::numbers::pi * 3.4 / 5;
  pyramids.positions[3] = std::cos(across);
  pyramids.positions[4] = std::sin(across);
  pyramids.positions[5] = 0.05;
  CHECK_THAT(closed_surface_fault(pyramids), Contains("crosses itself: triangles"));
}

TEST_CASE("a surface whose sides cross edge on edge crosses itself") {
  // A prism on a bow tie, one shell: its left wing is inside out, so the volumes of both would be taken from each other.
  const mesh::Surface prism{
      .positions = {0, -1, 0, 1, 0, 0, -2, 0, 0, 0, 2, 0, 0, -1, 1, 1, 0, 1, -2, 0, 1, 0, 2, 1},
      .triangles = {{0, 1, 5},
                    {0, 5, 4},
                    {1, 2, 6},
                    {1, 6, 5},
                    {2, 3, 7},
                    {2, 7, 6},
                    {3, 0, 7},
                    {0, 4, 7},
                    {0, 2, 1},
                    {0, 3, 2},
                    {4, 5, 6},
                    {4, 6, 7}}};
  CHECK_THAT(closed_surface_fault(prism), Contains("crosses itself: triangles"));
}

TEST_CASE("flat faces of many triangles do not cross themselves, however they are turned") {
  mesh::Surface block = cube();
  for (int round = 0; round < 3; ++round) {
    std::map<std::pair<mesh::Index, mesh::Index>, mesh::Index> middles;
    std::vector<std::array<mesh::Index, 3>> finer;
    const auto middle = [&](mesh::Index a, mesh::Index b) {
      const auto [found, is_new] = middles.emplace(std::minmax(a, b), block.node_count());
      if (is_new) test::add_node(block, 0.5 * (node_of(block, a) + node_of(block, b)));
      return found->second;
    };
    for (const auto& [a, b, c] : block.triangles) {
      const mesh::Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    block.triangles = finer;
  }
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  for (int turn = 0; turn < 20; ++turn) {
    const Eigen::Matrix3d axes =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
            .normalized()
            .matrix();
    mesh::Surface turned = block;
    Eigen::Map<Eigen::Matrix3Xd> nodes(turned.positions.data(), 3, turned.node_count());
    nodes = (axes * nodes).eval();
    REQUIRE(closed_surface_fault(turned).empty());
  }
}

TEST_CASE("a rock of a surface in map coordinates has the mass and inertia of the same rock at the origin") {
  const mesh::Surface rock = test::rock_surface(2);
  const Vector3 map(2600000, 1200000, 1500);
  const BuiltRock here = built_from(rock, 0.1), there = built_from(moved(rock, map), 0.1),
                  with_origin = built_from(moved(rock, map), 0.1, map);
  // Coordinates of seven digits before the point are rounded to 5e-10 m.
  for (const BuiltRock& other : {there, with_origin}) {
    CHECK(other.rock.mass == Approx(here.rock.mass).epsilon(1e-7));
    CHECK(other.rock.moments.x == Approx(here.rock.moments.x).epsilon(1e-7));
    CHECK(other.rock.moments.z == Approx(here.rock.moments.z).epsilon(1e-7));
    CHECK(other.spheres.size() == here.spheres.size());
  }
}

TEST_CASE("a rock of spheres in map coordinates has the mass and inertia of the same rock at the origin") {
  const auto built_at = [](const Vector3& place) {
    RockScene scene;
    scene.shape = SpheresShapeScene{.centres = {place, place + Vector3(0.25, 0, 0)}, .radii = {0.25, 0.125}};
    return build_rock("rock", scene, 2600).rock;
  };
  const RockInput here = built_at(Vector3::Zero()), there = built_at(Vector3(2600000, 1200000, 1500));
  CHECK(there.mass == Approx(here.mass).epsilon(1e-12));
  CHECK(there.moments.x == Approx(here.moments.x).epsilon(1e-12));
  CHECK(there.moments.y == Approx(here.moments.y).epsilon(1e-12));
}

TEST_CASE("a rock's surface that is inside out is turned over, one with lines beside it is refused") {
  const mesh::Surface rock = test::rock_surface(2);
  CHECK(built_from(turned_over(rock), 0.1).rock.mass ==
        Approx(built_from(rock, 0.1).rock.mass).epsilon(1e-12));
  test::Folder folder("rock_lines");
  folder.add("rock.obj", obj_of(rock) + "l 1 2\n");
  SurfaceScene from_file;
  from_file.file.path = folder / "rock.obj";
  from_file.deviation = 0.1;
  RockScene scene;
  scene.shape = from_file;
  CHECK_THROWS_WITH(build_rock("rock", scene, 2600),
                    Contains("particles.rocks.rock: the file holds 1 lines beside its triangles"));
}
