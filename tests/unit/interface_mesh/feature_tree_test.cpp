#include "interface_mesh/feature_tree.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "interface_mesh/closest_point.hpp"
#include "interface_mesh/points.hpp"
#include "tests/support/random_point.hpp"

using namespace talus;
using core::Vector3;
using mesh::Index;

namespace {

/// Triangles and segments of sizes over four decades, thrown anywhere, and a few nodes that belong to none.
mesh::Surface random_features(std::mt19937& random) {
  std::uniform_real_distribution<double> decade(-4, 0);
  mesh::Surface surface;
  const auto add_nodes = [&](int count) {
    const Index first = surface.node_count();
    const Vector3 middle = tests::random_point(random);
    const double size = std::pow(10, decade(random));
    for (int i = 0; i < count; ++i)
      mesh::append(surface.positions, middle + size * tests::random_point(random));
    return first;
  };
  for (int i = 0; i < 150; ++i) {
    const Index first = add_nodes(3);
    surface.triangles.push_back({first, first + 1, first + 2});
  }
  for (int i = 0; i < 150; ++i) {
    const Index first = add_nodes(2);
    surface.segments.push_back({first, first + 1});
  }
  for (int i = 0; i < 20; ++i) add_nodes(1);
  return surface;
}

double brute_force_distance(const mesh::Surface& surface, const Vector3& at) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto node = [&](Index index) { return mesh::point(surface.positions, index); };
  for (const auto& [a, b, c] : surface.triangles)
    nearest = std::min(nearest, mesh::closest_on_triangle(at, {node(a), node(b), node(c)}).distance_squared);
  for (const auto& [a, b] : surface.segments)
    nearest = std::min(nearest, mesh::closest_on_segment(at, {node(a), node(b)}).distance_squared);
  for (Index index = 0; index < surface.node_count(); ++index)
    nearest = std::min(nearest, (node(index) - at).squaredNorm());
  return std::sqrt(nearest);
}

}  // namespace

TEST_CASE("the nearest feature found by the tree is as near as that of a search through all") {
  std::mt19937 random(7);
  for (int surfaces = 0; surfaces < 5; ++surfaces) {
    const auto surface = random_features(random);
    const auto tree = mesh::FeatureTree::of_features(surface);
    for (int query = 0; query < 400; ++query) {
      const Vector3 at = (query % 2 ? 1.2 : 20.0) * tests::random_point(random);
      const auto found = tree.nearest(at);
      REQUIRE(found.distance == Approx(brute_force_distance(surface, at)).epsilon(1e-13));
      Vector3 tied = Vector3::Zero();
      for (std::size_t k = 0; k < static_cast<std::size_t>(found.count); ++k)
        tied += found.weights[k] * mesh::point(surface.positions, found.nodes[k]);
      REQUIRE((tied - at).norm() == Approx(found.distance).epsilon(1e-12));
    }
  }
}

TEST_CASE("the nearest node found by the tree is as near as that of a search through all") {
  std::mt19937 random(8);
  const auto surface = random_features(random);
  const auto tree = mesh::FeatureTree::of_nodes(surface);
  for (int query = 0; query < 500; ++query) {
    const Vector3 at = 1.5 * tests::random_point(random);
    double nearest = std::numeric_limits<double>::infinity();
    for (Index node = 0; node < surface.node_count(); ++node)
      nearest = std::min(nearest, (mesh::point(surface.positions, node) - at).norm());
    const auto found = tree.nearest(at);
    REQUIRE(found.count == 1);
    REQUIRE(found.distance == nearest);
  }
}

TEST_CASE("among equally near features the first triangle wins over segments") {
  const mesh::Surface surface{.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0},
                              .segments = {{0, 1}, {0, 2}},
                              .triangles = {{0, 1, 2}, {0, 2, 3}},
                              .parts = {}};
  const auto tree = mesh::FeatureTree::of_features(surface);
  const auto on_diagonal = tree.nearest({0.5, 0.5, 3});
  REQUIRE(on_diagonal.count == 2);
  CHECK(on_diagonal.nodes == std::array<Index, 3>{0, 2, 0});
  CHECK(on_diagonal.distance == 3);
}

TEST_CASE("many features at one place do not break the tree") {
  mesh::Surface surface{.positions = {0, 0, 0, 1, 0, 0}};
  for (int i = 0; i < 1000; ++i) surface.segments.push_back({0, 1});
  const auto found = mesh::FeatureTree::of_features(surface).nearest({0.25, 1, 0});
  CHECK(found.weights == std::array{0.75, 0.25, 0.0});
}
