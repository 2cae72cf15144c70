#include "interface_mesh/sheet.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "interface_mesh/points.hpp"
#include "interface_mesh/surface_checks.hpp"
#include "interface_mesh/triangulation.hpp"

using namespace talus;
using core::Vector3;
using mesh::Index;
using mesh::Polygon;
using mesh::Vector2;

namespace {

/// Concave, with corners of 45 to 315 degrees and edges of very different lengths.
Polygon barrier_outline() {
  return {{0, 0}, {10, 0}, {12, 3}, {7, 3.5}, {6, 2.5}, {5, 4}, {-1, 3}, {-1, 1}};
}

mesh::Panel flat_panel(const Polygon& outline) {
  std::vector<Vector3> corners;
  for (const auto& corner : outline) corners.emplace_back(corner.x(), corner.y(), 0);
  return mesh::make_panel(corners);
}

double area(const mesh::Surface& surface, const Vector3& normal) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const Vector3 p = mesh::point(surface.positions, a);
    const double part =
        (mesh::point(surface.positions, b) - p).cross(mesh::point(surface.positions, c) - p).dot(normal) / 2;
    CHECK(part > 0);
    sum += part;
  }
  return sum;
}

double smallest_angle(const mesh::Surface& surface) {
  double smallest = 180;
  for (const auto& triangle : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 p = mesh::point(surface.positions, triangle[k]);
      const Vector3 a = mesh::point(surface.positions, triangle[(k + 1) % 3]) - p;
      const Vector3 b = mesh::point(surface.positions, triangle[(k + 2) % 3]) - p;
      smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
    }
  return smallest;
}

}  // namespace

TEST_CASE("a sheet fills its outline: same area, all triangles turned the same way, no faults") {
  for (const double size : {2.0, 0.5, 0.13}) {
    const auto net =
        mesh::generate(mesh::Sheet{.panel = flat_panel(barrier_outline()), .element_size = size});
    CHECK(area(net.surface, Vector3::UnitZ()) == Approx(mesh::signed_area(barrier_outline())).epsilon(1e-12));
    CHECK(mesh::faults(net.surface).empty());
  }
}

TEST_CASE("no triangle of a sheet with corners above 45 degrees has an angle below 25 degrees") {
  for (const double size : {0.6, 0.31, 0.1}) {
    const auto net =
        mesh::generate(mesh::Sheet{.panel = flat_panel(barrier_outline()), .element_size = size});
    CHECK(smallest_angle(net.surface) > 25);
  }
}

TEST_CASE("a sheet has about as many triangles as equilateral ones of the wanted size fill its area") {
  const double size = 0.2;
  const auto net = mesh::generate(mesh::Sheet{.panel = flat_panel(barrier_outline()), .element_size = size});
  const double expected = mesh::signed_area(barrier_outline()) / (std::sqrt(3.0) / 4 * size * size);
  CHECK(double(net.surface.triangles.size()) == Approx(expected).epsilon(0.1));
}

TEST_CASE("prescribed edge nodes and corners are nodes of the sheet, and edges run from corner to corner") {
  const Polygon outline = barrier_outline();
  const std::vector<Vector2> shackles{{0.7, 0}, {0.9, 0}, {4.1, 0}, {11, 1.5}, {10, 0}};
  const auto net = mesh::generate(mesh::Sheet{
      .panel = flat_panel(outline), .element_size = 0.5, .edge_spacing = 0.8, .edge_nodes = shackles});
  const auto is_node = [&](const Vector2& place) {
    const auto& rim = net.find_set("rim")->nodes;
    return std::any_of(rim.begin(), rim.end(), [&](Index node) {
      return (mesh::point(net.surface.positions, node) - Vector3(place.x(), place.y(), 0)).norm() < 1e-12;
    });
  };
  for (const auto& place : shackles) CHECK(is_node(place));
  for (const auto& place : outline) CHECK(is_node(place));
  const auto& first_edge = net.find_set("edge_1")->nodes;
  double before = -1;
  for (const Index node : first_edge) {
    const Vector3 at = mesh::point(net.surface.positions, node);
    CHECK(at.y() == 0);
    CHECK(at.x() > before);
    before = at.x();
  }
  // 0.7, 0.2, 3.2 and 5.9 m between fixed nodes at a spacing of 0.8 m: 1, 1, 4 and 7 parts.
  CHECK(first_edge.size() == 1 + 1 + 1 + 4 + 7);
  CHECK(net.find_set("corners")->nodes.size() == outline.size());
  CHECK(mesh::faults(net.surface).empty());
}

TEST_CASE("a sheet stands where its panel stands in space") {
  const std::vector<Vector3> corners{{1, 2, 3}, {1, 6, 3}, {1, 6, 6}, {1, 2, 6}};
  const auto net = mesh::generate(mesh::Sheet{.panel = mesh::make_panel(corners), .element_size = 0.4});
  CHECK(area(net.surface, Vector3::UnitX()) == Approx(12).epsilon(1e-12));
  for (Index node = 0; node < net.surface.node_count(); ++node)
    REQUIRE(mesh::point(net.surface.positions, node).x() == Approx(1).epsilon(1e-14));
}

TEST_CASE("a rectangle left to the element size is divided in rows with alternating diagonals") {
  const auto panel =
      mesh::make_panel(mesh::Rectangle{Vector3(0, 0, 0), Vector3::UnitX(), Vector3::UnitZ(), 3, 2});
  const auto net = mesh::generate(mesh::Sheet{.panel = panel, .element_size = 0.5});
  CHECK(net.surface.node_count() == 7 * 5);
  CHECK(net.surface.triangles.size() == 2 * 6 * 4);
  CHECK(net.surface.segments.empty());
  CHECK(area(net.surface, -Vector3::UnitY()) == Approx(6).epsilon(1e-14));
  CHECK(net.find_set("edge_south")->nodes.size() == 7);
  std::array<int, 2> diagonals{};
  for (const auto& [a, b, c] : net.surface.triangles)
    for (const auto& [i, j] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      const Vector3 edge = mesh::point(net.surface.positions, j) - mesh::point(net.surface.positions, i);
      if (edge.x() * edge.z() != 0) ++diagonals[edge.x() * edge.z() > 0];
    }
  CHECK(diagonals[0] == diagonals[1]);
}

TEST_CASE(
    "cells cut by both diagonals lay edges of triangles along the wires of a chain-link net, at each node") {
  const double x = 0.097, y = 0.168;
  const auto panel =
      mesh::make_panel(mesh::Rectangle{Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY(), 10 * x, 6 * y});
  const auto net = mesh::generate(mesh::Sheet{.panel = panel, .crossed_cells = {5, 3}});
  CHECK(net.surface.node_count() == 6 * 4 + 5 * 3);
  CHECK(net.find_set("nodes")->nodes.size() == 6 * 4 + 5 * 3);
  CHECK(net.find_set("edge_east")->nodes.size() == 4);
  CHECK(net.surface.triangles.size() == 4 * 5 * 3);
  CHECK(mesh::faults(net.surface).empty());
  CHECK(area(net.surface, Vector3::UnitZ()) == Approx(60 * x * y).epsilon(1e-14));
  // Both families of wires pass through each triangle: one of its edges along either.
  for (const auto& [a, b, c] : net.surface.triangles) {
    std::array<int, 2> along_wires{};
    for (const auto& [i, j] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      const Vector3 edge = mesh::point(net.surface.positions, j) - mesh::point(net.surface.positions, i);
      if (std::abs(edge.x() * y - edge.y() * x) < 1e-12) ++along_wires[0];
      if (std::abs(edge.x() * y + edge.y() * x) < 1e-12) ++along_wires[1];
    }
    REQUIRE(along_wires == std::array{1, 1});
  }
}

TEST_CASE("no point of a triangulation is inside the circle of a triangle on the same side of the outline") {
  const Polygon outline{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  mesh::Triangulation triangulation(outline);
  // Irrational steps: no four points on a circle, no three on a line.
  for (int i = 1; i <= 200; ++i)
    triangulation.add(
        {4 * std::fmod(i * std::numbers::sqrt2, 1.0), 4 * std::fmod(i * std::numbers::sqrt3, 1.0)});
  const auto points = triangulation.points();
  for (const auto& [a, b, c] : triangulation.triangles()) {
    const Vector2 pa = points[std::size_t(a)], u = points[std::size_t(b)] - pa,
                  v = points[std::size_t(c)] - pa;
    const double twice = 2 * (u.x() * v.y() - u.y() * v.x());
    const Vector2 middle = Vector2(v.y() * u.squaredNorm() - u.y() * v.squaredNorm(),
                                   u.x() * v.squaredNorm() - v.x() * u.squaredNorm()) /
                           twice;
    for (const auto& point : points) REQUIRE((point - pa - middle).norm() > middle.norm() * (1 - 1e-9));
  }
}

TEST_CASE("an outline that crosses itself, repeats a corner or has no area is found out") {
  using Kind = mesh::OutlineFault::Kind;
  CHECK_FALSE(mesh::find_fault(barrier_outline()));
  const auto bow = mesh::find_fault({{0, 0}, {2, 2}, {2, 0}, {0, 2}});
  REQUIRE(bow);
  CHECK(bow->kind == Kind::crossing_edges);
  CHECK(bow->first == 0);
  CHECK(bow->second == 2);
  CHECK(mesh::find_fault({{0, 0}, {1, 0}})->kind == Kind::too_few_corners);
  CHECK(mesh::find_fault({{0, 0}, {1, 0}, {1, 1}, {0, 0}})->kind == Kind::repeated_corner);
  CHECK(mesh::find_fault({{0, 0}, {1, 0}, {2, 0}})->kind == Kind::no_area);
  // A corner that touches another edge.
  CHECK(mesh::find_fault({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}})->kind == Kind::crossing_edges);
}
