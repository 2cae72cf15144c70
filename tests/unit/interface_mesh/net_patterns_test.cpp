#include "interface_mesh/net_patterns.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "core/errors.hpp"
#include "interface_mesh/closest_point.hpp"
#include "interface_mesh/feature_tree.hpp"
#include "interface_mesh/points.hpp"
#include "interface_mesh/ring_panel.hpp"
#include "interface_mesh/surface_checks.hpp"
#include "interface_mesh/tubes.hpp"

using namespace talus;
using core::Vector3;
using mesh::Index;

namespace {

/// Values of common products: a TECCO-like chain-link, an 8 x 10 double twist, a ring net 12/3/300.
const mesh::SquarePattern square{.pitch = 0.2, .wire_diameter = 0.008};
const mesh::RhombicPattern rhombic{.diagonals = {0.083, 0.143}, .wire_diameter = 0.003};
const mesh::HexagonalPattern hexagonal{
    .mesh_size = {0.08, 0.1}, .twist_length = 0.04, .wire_diameter = 0.0027};
const mesh::RingPattern rings{.inner_diameter = 0.3, .wire_diameter = 0.003, .windings = 12};

mesh::Panel rectangle(double length, double width) {
  return mesh::make_panel(
      mesh::Rectangle{Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY(), length, width});
}

/// Length of single wire; `strands` wires run in each part.
double wire_length(const mesh::Surface& surface, const std::map<std::string, double>& strands) {
  double sum = 0;
  for (const auto& part : surface.parts)
    for (Index s = part.segment_begin; s < part.segment_end; ++s) {
      const auto [a, b] = surface.segments[std::size_t(s)];
      sum += strands.at(part.name) *
             (mesh::point(surface.positions, b) - mesh::point(surface.positions, a)).norm();
    }
  return sum;
}

/// A sphere's way out: pushed off the nearest wire, in the plane, until no wire is nearer than its radius.
/// True where it gets free. A sphere larger than the opening is pushed to and fro for good.
bool passes(const mesh::Surface& net, double diameter, Vector3 at) {
  struct Wire {
    Vector3 a, b;
    double radius;
  };
  std::vector<Wire> near;
  for (const auto& part : net.parts)
    for (Index s = part.segment_begin; s < part.segment_end; ++s) {
      const auto [i, j] = net.segments[std::size_t(s)];
      const Wire wire{mesh::point(net.positions, i), mesh::point(net.positions, j), part.wire_radius};
      if (std::sqrt(mesh::closest_on_segment(at, {wire.a, wire.b}).distance_squared) < 3 * diameter)
        near.push_back(wire);
    }
  for (int push = 0; push < 400; ++push) {
    double deepest = 1e-9 * diameter;
    Vector3 way = Vector3::Zero();
    for (const auto& wire : near) {
      const auto closest = mesh::closest_on_segment(at, {wire.a, wire.b});
      const double distance = std::sqrt(closest.distance_squared);
      const double overlap = diameter / 2 + wire.radius - distance;
      if (overlap <= deepest) continue;
      deepest = overlap;
      const Vector3 off = at - closest.weights[0] * wire.a - closest.weights[1] * wire.b;
      way = distance > 0 ? Vector3(off / distance) : (wire.b - wire.a).cross(Vector3::UnitZ()).normalized();
    }
    if (way.isZero()) return true;
    at += 1.02 * deepest * way;
  }
  return false;
}

/// From random places in the middle of a large panel, as many as `trials`.
int count_passing(const mesh::Lattice& lattice, double diameter, int trials) {
  const auto net = mesh::clip(lattice, rectangle(7 * lattice.cell.x(), 7 * lattice.cell.y())).surface;
  std::mt19937 random(21);
  std::uniform_real_distribution<double> in(3, 4);
  int passing = 0;
  for (int trial = 0; trial < trials; ++trial)
    passing += passes(net, diameter, Vector3(in(random)*lattice.cell.x(), in(random)*lattice.cell.y(), 0));
  return passing;
}

/// Wire length in whole cells, counted from a panel of n x n of them: the rows on two edges belong to the
/// next panels.
double length_per_area(const mesh::Lattice& lattice, const std::map<std::string, double>& strands) {
  const auto panel = [&](int cells) {
    // Off the lattice lines, so that no wire lies on the outline.
    return mesh::make_panel(mesh::Rectangle{Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY(),
                                            (cells + 0.37) * lattice.cell.x(),
                                            (cells + 0.41) * lattice.cell.y()});
  };
  // What the rim adds is linear in the cells along an edge, so second differences of n x n panels see whole
  // cells alone.
  std::array<double, 3> lengths{};
  for (int k = 0; k < 3; ++k)
    lengths[std::size_t(k)] = wire_length(mesh::clip(lattice, panel(4 + k)).surface, strands);
  return (lengths[2] - 2 * lengths[1] + lengths[0]) / (2 * lattice.cell.x() * lattice.cell.y());
}

}  // namespace

TEST_CASE("the wire length per area of each net is that of its data sheet") {
  // Snapping at the rim moves nodes by less than 5 % of a link; second differences cancel it.
  CHECK(length_per_area(lattice(square), {{"wire", 1}}) == Approx(2 / 0.2).epsilon(1e-9));
  CHECK(length_per_area(lattice(rhombic), {{"wire", 1}}) ==
        Approx(2 * std::hypot(0.083, 0.143) / (0.083 * 0.143)).epsilon(1e-9));
  // Each opening, 0.08 m wide on rows 0.07 m apart, owns a 40 mm twist of two wires and two sides of 3-4-5
  // triangles of 50 mm.
  CHECK(length_per_area(lattice(hexagonal), {{"wire", 1}, {"twist", 2}}) ==
        Approx((2 * 0.04 + 2 * 0.05) / (0.08 * 0.07)).epsilon(1e-9));
  CHECK(mesh::wire_length_per_area(hexagonal) ==
        Approx((2 * 0.04 + 2 * 0.05) / (0.08 * 0.07)).epsilon(1e-13));
}

TEST_CASE("a ring's polygon is shorter than its circle by what chords are shorter than arcs") {
  const double bundle = 0.003 * std::sqrt(12 * std::sqrt(12.0) / std::numbers::pi),
               radius = (0.3 + bundle) / 2;
  const double apex_angle = std::acos(0.15 / radius), arc_angle = (std::numbers::pi / 2 - 2 * apex_angle) / 4;
  const double polygon =
      8 * 2 * radius * std::sin(apex_angle / 2) + 16 * 2 * radius * std::sin(arc_angle / 2);
  CHECK(length_per_area(lattice(rings), {{"ring", 12}}) == Approx(12 * polygon / (0.3 * 0.3)).epsilon(1e-9));
  CHECK(mesh::wire_length_per_area(rings) ==
        Approx(2 * std::numbers::pi * radius * 12 / (0.3 * 0.3)).epsilon(1e-13));
  CHECK(polygon == Approx(2 * std::numbers::pi * radius).epsilon(0.004));
}

TEST_CASE("openings are those of the data sheets") {
  CHECK(mesh::opening(square) == Approx(0.192));
  // Area of the rhombus over its side is the distance of opposite sides.
  CHECK(mesh::opening(rhombic) == Approx((0.083 * 0.143 / 2) / (std::hypot(0.083, 0.143) / 2) - 0.003));
  // 80 mm from twist to twist, each 5.4 mm thick.
  CHECK(mesh::opening(hexagonal) == Approx(0.08 - 0.0054));
  CHECK(mesh::opening(rings) == Approx(0.3 - 2 * rings.bundle_diameter()));
}

TEST_CASE(
    "a sphere slightly smaller than the opening passes square, rhombic and hexagonal nets anywhere, a larger "
    "one nowhere",
    "[long]") {
  CHECK(count_passing(lattice(square), 0.99 * mesh::opening(square), 1000) == 1000);
  CHECK(count_passing(lattice(square), 1.01 * mesh::opening(square), 1000) == 0);
  CHECK(count_passing(lattice(rhombic), 0.99 * mesh::opening(rhombic), 1000) == 1000);
  CHECK(count_passing(lattice(rhombic), 1.01 * mesh::opening(rhombic), 1000) == 0);
  CHECK(count_passing(lattice(hexagonal), 0.99 * mesh::opening(hexagonal), 1000) == 1000);
  CHECK(count_passing(lattice(hexagonal), 1.01 * mesh::opening(hexagonal), 1000) == 0);
}

TEST_CASE("no sphere larger than a ring net's opening passes it, and one slightly smaller passes every ring",
          "[long]") {
  const double opening = mesh::opening(rings);
  CHECK(count_passing(lattice(rings), 1.01 * opening, 1000) == 0);
  // Smaller spheres can come to rest between four rings; over a ring they pass.
  const auto net = mesh::clip(lattice(rings), rectangle(7 * 0.3, 7 * 0.3)).surface;
  std::mt19937 random(22);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi), share(0, 1);
  for (int trial = 0; trial < 1000; ++trial) {
    const double direction = angle(random), distance = opening / 2 * std::sqrt(share(random));
    const Vector3 centre(3.5 * 0.3, 3.5 * 0.3, 0);
    REQUIRE(passes(net, 0.99 * opening,
                   centre + distance * Vector3(std::cos(direction), std::sin(direction), 0)));
  }
}

TEST_CASE("nets clipped to any outline are sound, keep inside it and end on it") {
  const mesh::Polygon outline{{0, 0}, {2.1, -0.3}, {2.4, 1.2}, {1.3, 0.9}, {0.9, 1.9}, {-0.4, 1.1}};
  std::vector<Vector3> corners;
  for (const auto& corner : outline) corners.emplace_back(corner.x(), corner.y(), 0.0);
  const auto panel = mesh::make_panel(corners);
  for (const auto& pattern : {lattice(square), lattice(rhombic), lattice(hexagonal), lattice(rings)}) {
    const auto net = mesh::clip(pattern, panel);
    CHECK(mesh::faults(net.surface).empty());
    std::vector<int> ends(std::size_t(net.surface.node_count()), 0);
    for (const auto& [a, b] : net.surface.segments) ++ends[std::size_t(a)], ++ends[std::size_t(b)];
    const auto& rim = net.find_set("rim")->nodes;
    const std::set<Index> on_rim(rim.begin(), rim.end());
    for (Index node = 0; node < net.surface.node_count(); ++node) {
      const Vector3 at = mesh::point(net.surface.positions, node);
      const double off = mesh::closest_on_outline(outline, at.head<2>()).distance;
      // Cut wires end on the outline and nowhere else; everything else is inside.
      REQUIRE(on_rim.count(node) == (off < 1e-9 ? 1 : 0));
      REQUIRE((on_rim.count(node) || mesh::contains(outline, at.head<2>())));
      REQUIRE((on_rim.count(node) || ends[std::size_t(node)] >= 2));
    }
    std::size_t edge_nodes = 0;
    for (std::size_t k = 1; k <= outline.size(); ++k)
      edge_nodes += net.find_set("edge_" + std::to_string(k))->nodes.size();
    CHECK(edge_nodes == rim.size() + net.find_set("corners")->nodes.size());
  }
}

TEST_CASE("no piece of wire at the rim is shorter than the snapping distance") {
  const auto panel = rectangle(3.03, 2.17);
  const auto net = mesh::clip(lattice(rhombic), panel);
  const double side = std::hypot(0.083, 0.143) / 2;
  for (const auto& [a, b] : net.surface.segments)
    REQUIRE((mesh::point(net.surface.positions, b) - mesh::point(net.surface.positions, a)).norm() >
            mesh::snap_of_link * side * 0.99);
}

TEST_CASE("a square pattern clipped to whole openings is the square net with its edges") {
  const auto net = mesh::clip(lattice(mesh::SquarePattern{.pitch = 0.15}), rectangle(3, 3));
  CHECK(net.surface.node_count() == 441);
  CHECK(net.surface.segments.size() == 840);
  CHECK(net.find_set("rim")->nodes.size() == 80);
  CHECK(net.find_set("corners")->nodes.size() == 4);
  CHECK(net.find_set("edge_south")->nodes.size() == 21);
}

TEST_CASE("a panel within one opening is refused") {
  const auto hole = mesh::make_panel(std::vector<Vector3>{{0, 0, 0}, {0.05, 0, 0}, {0, 0.05, 0}});
  auto pattern = lattice(rings);
  CHECK_THROWS_AS(mesh::clip(pattern, hole), core::ConfigError);
}

TEST_CASE("tubes have the lateral area of prisms around the wires and point outwards") {
  const auto wires = mesh::clip(lattice(square), rectangle(0.4, 0.4)).surface;
  const Index sides = 8;
  const auto tubes = mesh::as_tubes(wires, sides);
  CHECK(mesh::faults(tubes).empty());
  const auto nearest_wire = mesh::FeatureTree::of_features(wires);
  double area = 0;
  for (const auto& [a, b, c] : tubes.triangles) {
    const Vector3 p = mesh::point(tubes.positions, a), q = mesh::point(tubes.positions, b),
                  r = mesh::point(tubes.positions, c);
    const Vector3 normal = (q - p).cross(r - p) / 2;
    area += normal.norm();
    // Each corner is one wire radius from a wire's axis.
    CHECK(nearest_wire.nearest(p).distance <= 0.004 * (1 + 1e-12));
    // Its middle is a third of a pitch from the crossings, so the nearest wire is its own.
    const Vector3 middle = (p + q + r) / 3;
    const auto on_axis = nearest_wire.nearest(middle);
    Vector3 axis = Vector3::Zero();
    for (std::size_t k = 0; k < std::size_t(on_axis.count); ++k)
      axis += on_axis.weights[k] * mesh::point(wires.positions, on_axis.nodes[k]);
    CHECK(normal.dot(middle - axis) > 0);
  }
  const double length = wire_length(wires, {{"wire", 1}});
  CHECK(area == Approx(length * sides * 2 * 0.004 * std::sin(std::numbers::pi / sides)).epsilon(1e-12));
}

TEST_CASE("a panel of rings is as many closed polygons as go into it, with a node where two rings touch") {
  const mesh::Net net = mesh::ring_polygons(0.3, rectangle(1.2, 0.9));
  REQUIRE(net.surface.segments.size() == 4 * 12);
  // 12 rings have 48 contacts; 3 x 3 + 4 x 2 = 17 of them are shared.
  CHECK(net.surface.node_count() == 48 - 17);
  for (std::size_t ring = 0; ring < 12; ++ring)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto side = net.surface.segments[4 * ring + k];
      CHECK(side[1] == net.surface.segments[4 * ring + (k + 1) % 4][0]);
      const Vector3 a = mesh::point(net.surface.positions, side[0]),
                    b = mesh::point(net.surface.positions, side[1]);
      CHECK((b - a).norm() == Approx(0.3 / std::numbers::sqrt2).epsilon(1e-12));
    }
  CHECK(mesh::faults(net.surface).empty());
}

TEST_CASE(
    "the rim of a panel of rings is the outer ends of its rings, counter-clockwise, without the corners") {
  const mesh::Net net = mesh::ring_polygons(0.3, rectangle(1.2, 0.9));
  const auto places = [&](const char* set) {
    std::vector<std::array<double, 2>> all;
    for (const Index node : net.find_set(set)->nodes) {
      const Vector3 x = mesh::point(net.surface.positions, node);
      all.push_back({std::round(1e6 * x.x()) / 1e6, std::round(1e6 * x.y()) / 1e6});
    }
    return all;
  };
  using Places = std::vector<std::array<double, 2>>;
  CHECK(places("edge_south") == Places{{0.15, 0}, {0.45, 0}, {0.75, 0}, {1.05, 0}});
  CHECK(places("edge_east") == Places{{1.2, 0.15}, {1.2, 0.45}, {1.2, 0.75}});
  CHECK(places("edge_north") == Places{{1.05, 0.9}, {0.75, 0.9}, {0.45, 0.9}, {0.15, 0.9}});
  CHECK(places("rim").size() == 14);
  CHECK(
      places("corners") ==
      Places{{0, 0.15}, {0.15, 0}, {1.05, 0}, {1.2, 0.15}, {1.2, 0.75}, {1.05, 0.9}, {0.15, 0.9}, {0, 0.75}});
}

TEST_CASE(
    "rings fit a rectangle that is nearly whole, and any other outline holds the whole ones inside it") {
  CHECK(mesh::misfit(0.3, rectangle(3, 1.5)) == Approx(0).margin(1e-12));
  CHECK(mesh::misfit(0.3, rectangle(3.03, 1.5)) == Approx(0.01).epsilon(1e-9));
  const mesh::Net fitted = mesh::ring_polygons(0.3, rectangle(3.03, 1.5));
  CHECK(fitted.surface.segments.size() == 4 * 50);
  CHECK(fitted.find_set("edge_east")->nodes.size() == 5);
  // A right angle of 1.2 m: 3 + 2 + 1 squares of rings below its slope, and of those cut by it the ones whose four
  // nodes are inside, which is none.
  const mesh::Panel triangle = mesh::make_panel(std::vector<Vector3>{{0, 0, 0}, {1.2, 0, 0}, {0, 1.2, 0}});
  CHECK(mesh::ring_polygons(0.3, triangle).surface.segments.size() == 4 * 6);
  CHECK_THROWS_AS(mesh::ring_polygons(2, triangle), core::ConfigError);
}

TEST_CASE("a ring of two nodes goes there and back, which in other lines is a segment that is there twice") {
  mesh::Surface ring{.positions = {0, 0, 0, 0.3, 0, 0}, .segments = {{0, 1}, {1, 0}}};
  CHECK(mesh::faults(ring).size() == 1);
  CHECK(mesh::faults(ring, mesh::Segments::directed).empty());
  ring.segments.push_back({0, 1});
  CHECK(mesh::faults(ring, mesh::Segments::directed).size() == 1);
}
