#include "interface_mesh/feature_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "interface_mesh/closest_point.hpp"
#include "interface_mesh/points.hpp"

namespace talus::mesh {

using core::Vector3;

namespace {

constexpr Index leaf_size = 4;
/// Halving 2^31 features ends at depth 29; each level leaves one node waiting.
constexpr std::size_t deepest = 32;

/// Squared distance to a box, 0 inside (m^2).
double distance_squared(const Vector3& point, const Vector3& low, const Vector3& high) noexcept {
  return (point - point.cwiseMax(low).cwiseMin(high)).squaredNorm();
}

}  // namespace

struct FeatureTree::Candidate {
  double distance_squared = std::numeric_limits<double>::infinity();
  const Feature* feature = nullptr;
  std::array<double, 3> weights{};
};

FeatureTree FeatureTree::of_features(const Surface& surface) {
  std::vector<Feature> features;
  features.reserve(surface.triangles.size() + surface.segments.size());
  std::vector<char> lone(static_cast<std::size_t>(surface.node_count()), 1);
  const auto add = [&](const auto& cell) {
    Feature feature{.corners = static_cast<int>(cell.size()), .order = static_cast<Index>(features.size())};
    std::copy(cell.begin(), cell.end(), feature.nodes.begin());
    for (const Index node : cell) lone[static_cast<std::size_t>(node)] = 0;
    features.push_back(feature);
  };
  for (const auto& triangle : surface.triangles) add(triangle);
  for (const auto& segment : surface.segments) add(segment);
  for (Index node = 0; node < surface.node_count(); ++node)
    if (lone[static_cast<std::size_t>(node)]) add(std::array{node});
  return {surface, std::move(features)};
}

FeatureTree FeatureTree::of_nodes(const Surface& surface) {
  std::vector<Feature> features(static_cast<std::size_t>(surface.node_count()));
  for (Index node = 0; node < surface.node_count(); ++node)
    features[static_cast<std::size_t>(node)] = {.nodes = {node}, .corners = 1, .order = node};
  return {surface, std::move(features)};
}

FeatureTree::FeatureTree(const Surface& surface, std::vector<Feature> features)
    : positions_(surface.positions), features_(std::move(features)) {
  nodes_.reserve(features_.size());
  if (!features_.empty()) build(0, static_cast<Index>(features_.size()));
}

FeatureTree::Box FeatureTree::box_of(const Feature& feature) const {
  Box box{point(positions_, feature.nodes[0]), point(positions_, feature.nodes[0])};
  for (int corner = 1; corner < feature.corners; ++corner) {
    const Vector3 at = point(positions_, feature.nodes[static_cast<std::size_t>(corner)]);
    box.low = box.low.cwiseMin(at);
    box.high = box.high.cwiseMax(at);
  }
  return box;
}

void FeatureTree::build(Index begin, Index end) {
  const auto self = nodes_.size();
  nodes_.push_back({box_of(features_[static_cast<std::size_t>(begin)]), 0, begin, end - begin});
  Box& box = nodes_[self].box;
  for (Index i = begin + 1; i < end; ++i) {
    const Box other = box_of(features_[static_cast<std::size_t>(i)]);
    box.low = box.low.cwiseMin(other.low);
    box.high = box.high.cwiseMax(other.high);
  }
  if (end - begin <= leaf_size) return;

  Eigen::Index axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const auto twice_middle = [&](const Feature& feature) {
    const Box of = box_of(feature);
    return of.low[axis] + of.high[axis];
  };
  const Index middle = begin + (end - begin) / 2;
  std::nth_element(features_.begin() + begin, features_.begin() + middle, features_.begin() + end,
                   [&](const Feature& a, const Feature& b) { return twice_middle(a) < twice_middle(b); });
  nodes_[self].count = 0;
  build(begin, middle);
  nodes_[self].right = static_cast<Index>(nodes_.size());
  build(middle, end);
}

void FeatureTree::compare(const Feature& feature, const Vector3& at, Candidate& best) const noexcept {
  const Vector3 a = point(positions_, feature.nodes[0]);
  double distance_squared = 0;
  std::array<double, 3> weights{1, 0, 0};
  if (feature.corners == 1) {
    distance_squared = (a - at).squaredNorm();
  } else if (feature.corners == 2) {
    const auto closest = closest_on_segment(at, {a, point(positions_, feature.nodes[1])});
    distance_squared = closest.distance_squared;
    weights = {closest.weights[0], closest.weights[1], 0};
  } else {
    const auto closest = closest_on_triangle(
        at, {a, point(positions_, feature.nodes[1]), point(positions_, feature.nodes[2])});
    distance_squared = closest.distance_squared;
    weights = closest.weights;
  }
  const bool first_of_equals =
      distance_squared == best.distance_squared && feature.order < best.feature->order;
  if (distance_squared < best.distance_squared || first_of_equals)
    best = {distance_squared, &feature, weights};
}

SurfacePoint FeatureTree::nearest(const Vector3& at) const noexcept {
  const auto distance_to = [&](Index node) {
    const Box& box = nodes_[static_cast<std::size_t>(node)].box;
    return distance_squared(at, box.low, box.high);
  };
  struct Waiting {
    Index node;
    double distance_squared;
  };
  std::array<Waiting, deepest> waiting;
  std::size_t count = 0;
  waiting[count++] = {0, distance_to(0)};
  Candidate best;
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (next.distance_squared > best.distance_squared) continue;
    const TreeNode& node = nodes_[static_cast<std::size_t>(next.node)];
    for (Index i = 0; i < node.count; ++i)
      compare(features_[static_cast<std::size_t>(node.begin + i)], at, best);
    if (node.count > 0) continue;
    Waiting near{next.node + 1, distance_to(next.node + 1)}, far{node.right, distance_to(node.right)};
    if (far.distance_squared < near.distance_squared) std::swap(near, far);
    waiting[count++] = far;
    waiting[count++] = near;
  }

  SurfacePoint result{.distance = std::sqrt(best.distance_squared)};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    if (best.weights[corner] == 0) continue;
    const auto last = static_cast<std::size_t>(result.count++);
    result.nodes[last] = best.feature->nodes[corner];
    result.weights[last] = best.weights[corner];
  }
  return result;
}

}  // namespace talus::mesh
