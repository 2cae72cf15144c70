#include "interface_mesh/panel.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <tuple>

namespace talus::mesh {

using core::Vector3;

namespace {

/// A rim node this close to a corner, as a share of the edge, stands on it.
constexpr double corner_share = 1e-9;
/// An area vector shorter than this part of its largest triangle's is round-off.
constexpr double nothing_of_triangle = 1e-9;

/// Unit normal of the plane that fits a closed polygon: its area vector (Newell). That of a bow tie vanishes,
/// and its largest triangle gives the plane, so that what is wrong with it can be said.
Vector3 plane_normal(const std::vector<Vector3>& corners) {
  Vector3 sum = Vector3::Zero(), largest = Vector3::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const Vector3 triangle = (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
    sum += triangle;
    if (triangle.squaredNorm() > largest.squaredNorm()) largest = triangle;
  }
  return (sum.norm() > nothing_of_triangle * largest.norm() ? sum : largest).normalized();
}

}  // namespace

Panel make_panel(const Rectangle& rectangle) {
  Panel panel{.origin = rectangle.corner, .along = rectangle.along.normalized()};
  panel.across = (rectangle.across - rectangle.across.dot(panel.along) * panel.along).normalized();
  panel.outline = {{0, 0}, {rectangle.length, 0}, {rectangle.length, rectangle.width}, {0, rectangle.width}};
  panel.edge_names = {"edge_south", "edge_east", "edge_north", "edge_west"};
  return panel;
}

Panel make_panel(const std::vector<Vector3>& corners) {
  const Vector3 normal = plane_normal(corners);
  const Vector3 first_edge = corners[1] - corners[0];
  Panel panel{.origin = corners[0], .along = (first_edge - first_edge.dot(normal) * normal).normalized()};
  panel.across = normal.cross(panel.along);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector3 from_origin = corners[k] - panel.origin;
    panel.outline.emplace_back(from_origin.dot(panel.along), from_origin.dot(panel.across));
    panel.edge_names.push_back("edge_" + std::to_string(k + 1));
  }
  return panel;
}

double flatness(const std::vector<Vector3>& corners) {
  if (corners.empty()) return 0;
  const Vector3 normal = plane_normal(corners);
  Vector3 middle = Vector3::Zero();
  for (const auto& corner : corners) middle += corner / double(corners.size());
  double largest = 0;
  for (const auto& corner : corners) largest = std::max(largest, std::abs((corner - middle).dot(normal)));
  return largest;
}

std::vector<NodeSet> rim_sets(const Panel& panel, std::vector<RimNode> rim, Index node_count) {
  const std::size_t edges = panel.outline.size();
  for (auto& node : rim)
    if (node.share > 1 - corner_share) node = {node.node, (node.edge + 1) % edges, 0};
  std::sort(rim.begin(), rim.end(), [](const RimNode& a, const RimNode& b) {
    return std::tie(a.edge, a.share, a.node) < std::tie(b.edge, b.share, b.node);
  });
  NodeSet all{"nodes", std::vector<Index>(static_cast<std::size_t>(node_count))}, whole_rim{"rim", {}},
      corners{"corners", {}};
  std::iota(all.nodes.begin(), all.nodes.end(), Index{0});
  std::vector<NodeSet> sets;
  for (const auto& name : panel.edge_names) sets.push_back({name, {}});
  for (const auto& node : rim) {
    whole_rim.nodes.push_back(node.node);
    sets[node.edge].nodes.push_back(node.node);
  }
  // A corner ends the edge before it and begins the edge after it.
  for (const auto& node : rim)
    if (node.share < corner_share) {
      corners.nodes.push_back(node.node);
      sets[(node.edge + edges - 1) % edges].nodes.push_back(node.node);
    }
  sets.insert(sets.begin(), {std::move(all), std::move(whole_rim), std::move(corners)});
  return sets;
}

}  // namespace talus::mesh
