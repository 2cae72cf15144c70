#include "interface_mesh/mapping.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/errors.hpp"
#include "interface_mesh/points.hpp"
#include "interface_mesh/square_net.hpp"

using namespace talus;
using core::Vector3;
using mesh::Index;

namespace {

/// Sums of thousands of rounded products: the errors of single terms (1e-16) add up like a random walk.
constexpr double round_off = 1e-12;

mesh::Surface net(Index openings) {
  return mesh::generate(mesh::SquareNet{.lengths = {3, 2}, .openings = {openings, openings}}).surface;
}

/// The same wires with a node more on each segment, at a third of it.
mesh::Surface finer_wires(mesh::Surface surface) {
  std::vector<std::array<Index, 2>> segments;
  for (const auto& [a, b] : surface.segments) {
    const Index middle = surface.node_count();
    const Vector3 start = mesh::point(surface.positions, a), end = mesh::point(surface.positions, b);
    mesh::append(surface.positions, start + (end - start) / 3);
    segments.push_back({a, middle});
    segments.push_back({middle, b});
  }
  surface.segments = segments;
  return surface;
}

/// The same rectangle as triangles: each opening halved.
mesh::Surface sheet(Index openings) {
  auto surface = net(openings);
  surface.segments.clear();
  const Index row = openings + 1;
  for (Index j = 0; j < openings; ++j)
    for (Index i = 0; i < openings; ++i) {
      const Index corner = j * row + i;
      surface.triangles.push_back({corner, corner + 1, corner + row + 1});
      surface.triangles.push_back({corner, corner + row + 1, corner + row});
    }
  surface.parts = {{.name = "sheet", .triangle_end = static_cast<Index>(surface.triangles.size())}};
  return surface;
}

struct Pair {
  std::string name;
  mesh::Surface boundary, structure;
};

/// In all of them the boundary lies on the structure.
std::vector<Pair> coinciding_pairs() {
  return {{"a net and itself", net(12), net(12)},
          {"finely divided wires on coarse ones", finer_wires(net(12)), net(12)},
          {"a net on a coarse sheet", net(17), sheet(5)},
          {"a fine sheet on a coarse sheet", sheet(23), sheet(7)},
          {"a sheet on a net it shares its lines with", sheet(6), net(6)}};
}

std::vector<double> random_values(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> in(-1, 1);
  std::vector<double> values(count);
  for (auto& value : values) value = in(random);
  return values;
}

struct Work {
  double sum = 0, largest_term = 0;
};
Work work(const std::vector<double>& force, const std::vector<double>& motion) {
  Work result;
  for (std::size_t i = 0; i < force.size(); ++i) {
    result.sum += force[i] * motion[i];
    result.largest_term = std::max(result.largest_term, std::abs(force[i] * motion[i]));
  }
  return result;
}

std::vector<double> at_boundary(const mesh::Mapping& mapping, const std::vector<double>& motion) {
  std::vector<double> result(3 * static_cast<std::size_t>(mapping.boundary_nodes()));
  mapping.to_boundary(motion, result);
  return result;
}

}  // namespace

TEST_CASE("virtual work of any motion is the same on both sides") {
  std::mt19937 random(11);
  for (const auto& [name, boundary, structure] : coinciding_pairs()) {
    INFO(name);
    for (const auto& tied : {mesh::tie_to_nearest_feature(boundary, structure),
                             mesh::tie_to_nearest_node(boundary, structure, 10.0)}) {
      const auto motion = random_values(structure.positions.size(), random);
      const auto force = random_values(boundary.positions.size(), random);
      std::vector<double> structure_force(structure.positions.size());
      tied.mapping.to_structure(force, structure_force);
      const auto on_boundary = work(force, at_boundary(tied.mapping, motion));
      const auto on_structure = work(structure_force, motion);
      CHECK(std::abs(on_boundary.sum - on_structure.sum) <
            round_off * std::max(on_boundary.largest_term, on_structure.largest_term));
    }
  }
}

TEST_CASE("total force and total moment are the same on both sides of surfaces that coincide") {
  std::mt19937 random(12);
  for (const auto& [name, boundary, structure] : coinciding_pairs()) {
    INFO(name);
    const auto tied = mesh::tie_to_nearest_feature(boundary, structure);
    const auto force = random_values(boundary.positions.size(), random);
    const auto error = mesh::transfer_error(tied.mapping, boundary, structure, force);
    CHECK(tied.largest_distance < 1e-15);
    CHECK(error.force.norm() < round_off * error.largest_force);
    CHECK(error.moment.norm() < round_off * error.largest_moment);
  }
}

TEST_CASE("the total moment changes by the moment of the offsets and by nothing else") {
  const auto structure = sheet(5);
  auto boundary = net(9);
  std::mt19937 random(13);
  std::uniform_real_distribution<double> offset(-0.02, 0.02);
  const auto force = random_values(boundary.positions.size(), random);
  Vector3 expected = Vector3::Zero();
  for (Index node = 0; node < boundary.node_count(); ++node) {
    const double z = offset(random);
    boundary.positions[3 * static_cast<std::size_t>(node) + 2] = z;
    expected += Vector3(0, 0, -z).cross(mesh::point(force, node));
  }
  const auto tied = mesh::tie_to_nearest_feature(boundary, structure);
  const auto error = mesh::transfer_error(tied.mapping, boundary, structure, force);
  CHECK((error.moment - expected).norm() < round_off * error.largest_moment);
  CHECK(error.force.norm() < round_off * error.largest_force);
}

TEST_CASE("a rigid motion and a linear field of the structure are reproduced exactly at the boundary") {
  const Eigen::Matrix3d gradient{{0.3, -1.2, 0.5}, {0.7, 0.1, -0.4}, {-0.9, 0.6, 1.1}};
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  const Vector3 shift(0.3, -2, 5);
  for (const Eigen::Matrix3d& map : {gradient, Eigen::Matrix3d(turn - Eigen::Matrix3d::Identity())})
    for (const auto& [name, boundary, structure] : coinciding_pairs()) {
      INFO(name);
      std::vector<double> motion;
      for (Index node = 0; node < structure.node_count(); ++node)
        mesh::append(motion, map * mesh::point(structure.positions, node) + shift);
      const auto carried = at_boundary(mesh::tie_to_nearest_feature(boundary, structure).mapping, motion);
      for (Index node = 0; node < boundary.node_count(); ++node) {
        const Vector3 exact = map * mesh::point(boundary.positions, node) + shift;
        REQUIRE((mesh::point(carried, node) - exact).norm() < round_off * exact.norm());
      }
    }
}

TEST_CASE("identical meshes hand values over bit for bit in both directions") {
  const auto surface = net(12);
  std::mt19937 random(15);
  const auto values = random_values(surface.positions.size(), random);
  for (const auto& tied :
       {mesh::tie_to_nearest_feature(surface, surface), mesh::tie_to_nearest_node(surface, surface)}) {
    CHECK(at_boundary(tied.mapping, values) == values);
    std::vector<double> force(values.size());
    tied.mapping.to_structure(values, force);
    CHECK(force == values);
    CHECK(tied.mapping.bytes_to_boundary() == 0);
  }
}

TEST_CASE("the nearest-node mapping loses a linear field that the nearest-feature mapping keeps") {
  const auto boundary = net(24), structure = net(12);
  const auto carried =
      at_boundary(mesh::tie_to_nearest_node(boundary, structure, 1.0).mapping, structure.positions);
  double worst = 0;
  for (Index node = 0; node < boundary.node_count(); ++node)
    worst = std::max(worst, (mesh::point(carried, node) - mesh::point(boundary.positions, node)).norm());
  // Nodes halfway between two wires' nodes are off by half the coarse pitch of 3 m / 12 along the longer
  // direction, or by the diagonal where they are in the middle of an opening.
  CHECK(worst == Approx(0.5 * std::hypot(3.0 / 12, 2.0 / 12)).epsilon(1e-12));
}

TEST_CASE("the mass behind a tied node is what a force on it accelerates") {
  const auto boundary = net(17), structure = sheet(5);
  const auto tied = mesh::tie_to_nearest_feature(boundary, structure);
  std::mt19937 random(16);
  std::uniform_real_distribution<double> mass(0.1, 10);
  std::vector<double> masses(static_cast<std::size_t>(structure.node_count()));
  for (auto& value : masses) value = mass(random);
  const auto behind = tied.mapping.boundary_masses(masses);
  for (const std::size_t node : {0U, 25U, 100U, 200U}) {
    std::vector<double> force(boundary.positions.size()), structure_force(structure.positions.size());
    force[3 * node] = 1;
    tied.mapping.to_structure(force, structure_force);
    auto acceleration = structure_force;
    for (std::size_t i = 0; i < acceleration.size(); ++i) acceleration[i] /= masses[i / 3];
    CHECK(1 / at_boundary(tied.mapping, acceleration)[3 * node] == Approx(behind[node]).epsilon(1e-13));
  }
}

TEST_CASE("orphaned nodes are refused with their coordinates and distance") {
  const auto structure = sheet(5);
  auto boundary = net(5);
  boundary.positions[3 * 7 + 2] = 0.5;
  CHECK_THROWS_AS(mesh::tie_to_nearest_feature(boundary, structure), core::ConfigError);
  CHECK_THROWS_WITH(
      mesh::tie_to_nearest_feature(boundary, structure, 0.4),
      Catch::Contains("boundary node 7 at (0.6, 0.4, 0.5) m is 0.5 m away from the structure, more than the "
                      "tolerance of 0.4 m"));
  const auto tied = mesh::tie_to_nearest_feature(boundary, structure, 0.5);
  CHECK(tied.largest_distance == 0.5);
  CHECK(tied.farthest_node == 7);
  CHECK_THROWS_AS(mesh::tie_to_nearest_feature(boundary, mesh::Surface{}), core::ConfigError);
}

TEST_CASE("without a tolerance a hundredth of the structure's diagonal is allowed") {
  const auto structure = sheet(5);
  CHECK(mesh::tie_to_nearest_feature(net(5), structure).tolerance == Approx(0.01 * std::hypot(3.0, 2.0)));
}
