#include "interface_mesh/square_net.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "interface_mesh/open_rim.hpp"
#include "interface_mesh/points.hpp"
#include "interface_mesh/surface_checks.hpp"

using namespace talus;
using core::Vector3;
using mesh::Index;

namespace {

mesh::Net cable_net() {
  return mesh::generate(mesh::SquareNet{.lengths = {3, 3}, .openings = {20, 20}});
}

double wire_length(const mesh::Surface& surface) {
  double sum = 0;
  for (const auto& [a, b] : surface.segments)
    sum += (mesh::point(surface.positions, b) - mesh::point(surface.positions, a)).norm();
  return sum;
}

}  // namespace

TEST_CASE("a net of 20 x 20 openings has 21 x 21 nodes, 840 segments and 80 nodes on its rim") {
  const auto net = cable_net();
  CHECK(net.surface.node_count() == 441);
  CHECK(net.surface.segments.size() == 840);
  CHECK(net.find_set("nodes")->nodes.size() == 441);
  CHECK(net.find_set("rim")->nodes.size() == 80);
  CHECK(net.find_set("corners")->nodes.size() == 4);
  CHECK(net.find_set("no such set") == nullptr);
  CHECK(mesh::faults(net.surface).empty());
  // 21 wires of 3 m each way.
  CHECK(wire_length(net.surface) == Approx(2 * 21 * 3.0).epsilon(1e-13));
}

TEST_CASE("the middle node of the cable net is exactly at (1.5, 1.5, 0)") {
  const auto net = cable_net();
  CHECK(mesh::point(net.surface.positions, 220) == Vector3(1.5, 1.5, 0));
}

TEST_CASE("edges run counter-clockwise with both corners, and the rim is their union") {
  const auto net = mesh::generate(mesh::SquareNet{.lengths = {3, 2}, .openings = {3, 2}});
  CHECK(net.find_set("edge_south")->nodes == std::vector<Index>{0, 1, 2, 3});
  CHECK(net.find_set("edge_east")->nodes == std::vector<Index>{3, 7, 11});
  CHECK(net.find_set("edge_north")->nodes == std::vector<Index>{11, 10, 9, 8});
  CHECK(net.find_set("edge_west")->nodes == std::vector<Index>{8, 4, 0});
  CHECK(net.find_set("rim")->nodes == std::vector<Index>{0, 1, 2, 3, 7, 11, 10, 9, 8, 4});
  CHECK(net.find_set("corners")->nodes == std::vector<Index>{0, 3, 11, 8});
}

TEST_CASE("every segment of a turned net is one pitch long and lies along one of the two directions") {
  const Vector3 along(1, 2, 2), across(0, -1, 1);
  const auto net = mesh::generate(mesh::SquareNet{
      .corner = {4, -5, 6}, .along = along, .across = across, .lengths = {1.2, 0.8}, .openings = {6, 4}});
  int rows = 0, columns = 0;
  for (const auto& [a, b] : net.surface.segments) {
    const Vector3 span = mesh::point(net.surface.positions, b) - mesh::point(net.surface.positions, a);
    CHECK(span.norm() == Approx(0.2).epsilon(1e-12));
    rows += span.normalized().dot(along.normalized()) > 1 - 1e-12;
    columns += span.normalized().dot(across.normalized()) > 1 - 1e-12;
  }
  CHECK(rows == 6 * 5);
  CHECK(columns == 7 * 4);
}

TEST_CASE("no two nodes of a net coincide and no segment is there twice") {
  const auto net = cable_net();
  std::set<std::array<Index, 2>> segments;
  std::set<std::pair<long, long>> places;
  for (auto [a, b] : net.surface.segments) segments.insert({std::min(a, b), std::max(a, b)});
  for (Index node = 0; node < net.surface.node_count(); ++node) {
    const auto at = mesh::point(net.surface.positions, node);
    places.insert({std::lround(at.x() / 0.15), std::lround(at.y() / 0.15)});
  }
  CHECK(segments.size() == net.surface.segments.size());
  CHECK(places.size() == 441);
}

TEST_CASE("a net with an open rim has no wire along its outline and no corners, and its edges end on wires") {
  const auto net = mesh::without_rim_wires(cable_net());
  CHECK(net.surface.node_count() == 21 * 21 - 4);
  CHECK(wire_length(net.surface) == Approx(2 * 19 * 3.0).epsilon(1e-13));
  CHECK(mesh::faults(net.surface).empty());
  CHECK(net.find_set("corners") == nullptr);
  CHECK(net.find_set("rim")->nodes.size() == 4 * 19);
  const auto& south = net.find_set("edge_south")->nodes;
  REQUIRE(south.size() == 19);
  CHECK(mesh::point(net.surface.positions, south.front()).isApprox(Vector3(0.15, 0, 0), 1e-14));
  for (const auto& [a, b] : net.surface.segments) {
    const Vector3 middle =
        0.5 * (mesh::point(net.surface.positions, a) + mesh::point(net.surface.positions, b));
    CHECK((middle.array() > 0).head<2>().all());
    CHECK((middle.array() < 3).head<2>().all());
  }
}
