#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "core/vector3.hpp"
#include "interface_mesh/surface.hpp"

/// Closed surfaces for tests of rocks.
namespace talus::test {

inline core::Vector3 node_of(const mesh::Surface& surface, mesh::Index node) {
  return core::Vector3(&surface.positions[3 * static_cast<std::size_t>(node)]);
}

inline mesh::Index add_node(mesh::Surface& surface, const core::Vector3& at) {
  surface.positions.insert(surface.positions.end(), at.data(), at.data() + 3);
  return surface.node_count() - 1;
}

/// An octahedron whose faces are divided in four so many times, on the unit sphere: 8 * 4^divisions
/// triangles.
inline mesh::Surface sphere_surface(int divisions) {
  mesh::Surface surface;
  for (int k = 0; k < 6; ++k) add_node(surface, (k % 2 ? -1.0 : 1.0) * core::Vector3::Unit(k / 2));
  for (int x : {0, 1})
    for (int y : {2, 3})
      for (int z : {4, 5}) {
        if ((x + y + z) % 2 == 0)
          surface.triangles.push_back({x, y, z});
        else
          surface.triangles.push_back({x, z, y});
      }
  for (int round = 0; round < divisions; ++round) {
    std::map<std::pair<mesh::Index, mesh::Index>, mesh::Index> middles;
    const auto middle = [&](mesh::Index a, mesh::Index b) {
      const auto [found, is_new] = middles.emplace(std::minmax(a, b), surface.node_count());
      if (is_new) add_node(surface, (node_of(surface, a) + node_of(surface, b)).normalized());
      return found->second;
    };
    std::vector<std::array<mesh::Index, 3>> finer;
    for (const auto& [a, b, c] : surface.triangles) {
      const mesh::Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    surface.triangles = std::move(finer);
  }
  return surface;
}

/// The same with half axes of 0.6, 0.5 and 0.4 m, dented and bulged at random: like a scanned rock.
inline mesh::Surface rock_surface(int divisions, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  mesh::Surface surface = sphere_surface(divisions);
  Eigen::Map<Eigen::Matrix3Xd> nodes(surface.positions.data(), 3, surface.node_count());
  Eigen::VectorXd radius = Eigen::VectorXd::Ones(surface.node_count());
  for (int bump = 0; bump < 30; ++bump) {
    const core::Vector3 there = core::Vector3(normal(random), normal(random), normal(random)).normalized();
    radius.array() +=
        0.05 * normal(random) * (8 * ((there.transpose() * nodes).transpose().array() - 1)).exp();
  }
  nodes = core::Vector3(0.6, 0.5, 0.4).asDiagonal() * nodes * radius.asDiagonal();
  return surface;
}

/// Moves and scales every node.
inline mesh::Surface moved(mesh::Surface surface, const core::Vector3& by, double scale = 1) {
  for (std::size_t k = 0; k < surface.positions.size(); ++k)
    surface.positions[k] = scale * surface.positions[k] + by[static_cast<Eigen::Index>(k % 3)];
  return surface;
}

inline mesh::Surface turned_over(mesh::Surface surface) {
  for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
  return surface;
}

/// Both, with nodes of their own.
inline mesh::Surface together(mesh::Surface first, const mesh::Surface& second) {
  const mesh::Index nodes = first.node_count();
  first.positions.insert(first.positions.end(), second.positions.begin(), second.positions.end());
  for (const auto& [a, b, c] : second.triangles) first.triangles.push_back({a + nodes, b + nodes, c + nodes});
  return first;
}

}  // namespace talus::test
