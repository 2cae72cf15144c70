#pragma once

#include <array>
#include <vector>

#include "core/vector3.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::mesh {

/// A point of a surface: up to three of its nodes and their linear weights (not negative, sum 1; nodes of
/// weight 0 are left out).
struct SurfacePoint {
  std::array<Index, 3> nodes{};
  std::array<double, 3> weights{};
  int count = 0;
  double distance = 0;  ///< m; to the point that was asked for
};

/// Finds the nearest feature of a surface: triangle, segment or node. A binary tree of boxes over the
/// features, halved at the median of the longest side: O(n log n) to build, O(log n) a query for any spread
/// of feature sizes. The answer is exact; of features at the same distance the first of (triangles, segments,
/// lone nodes), each in the surface's order, is returned.
class FeatureTree {
 public:
  /// Over all triangles, segments, and the nodes that belong to neither. @pre check(surface) passes but for
  /// lone nodes
  static FeatureTree of_features(const Surface& surface);
  /// Over the nodes alone.
  static FeatureTree of_nodes(const Surface& surface);

  /// @pre the surface has a node. The surface may be gone.
  SurfacePoint nearest(const core::Vector3& point) const noexcept;
  bool empty() const { return features_.empty(); }

 private:
  struct Feature {
    std::array<Index, 3> nodes{};
    int corners = 0;  ///< 1 a node, 2 a segment, 3 a triangle
    Index order = 0;  ///< among equally near ones the lowest wins
  };
  struct Box {
    core::Vector3 low, high;
  };
  /// The children of an inner node are the next one and `right`; a leaf holds the features [begin, begin +
  /// count).
  struct TreeNode {
    Box box;
    Index right = 0;
    Index begin = 0, count = 0;
  };
  struct Candidate;

  FeatureTree(const Surface& surface, std::vector<Feature> features);
  Box box_of(const Feature& feature) const;
  void build(Index begin, Index end);
  void compare(const Feature& feature, const core::Vector3& point, Candidate& best) const noexcept;

  std::vector<double> positions_;
  std::vector<Feature> features_;
  std::vector<TreeNode> nodes_;
};

}  // namespace talus::mesh
