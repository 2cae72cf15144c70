#pragma once

#include <cstdint>
#include <vector>

#include "dem_solver/particles/row.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::dem {

/// A binary tree of boxes over the triangles of a surface, halved at the median of the longest side: the
/// nearest triangle of hundreds of thousands in a microsecond, and which of them may cross.
class TriangleTree {
 public:
  /// The surface must outlive the tree. @pre it has triangles, and they have areas
  explicit TriangleTree(const mesh::Surface& surface);

  /// m; from a point to the nearest triangle, the same bits as from a comparison with all of them.
  /// @param hint what the query of a point nearby left there, or 0; makes it faster
  double distance(const Triple<double>& point, std::int32_t& hint) const noexcept;

  /// Calls visit(i, j) for pairs of triangles whose boxes touch, i < j, each once, until it returns true.
  /// @return whether it did
  template <class Visit>
  bool any_touching(const Visit& visit) const {
    return any_touching(visit, 0, 0);
  }

 private:
  struct Box {
    Triple<double> low, high;
    bool touches(const Box& other) const noexcept;
  };
  /// The children of an inner node are the next one and `right`; a leaf holds count > 0 triangles.
  struct Node {
    Box box;
    std::int32_t right = 0, begin = 0, count = 0;
  };

  struct Corners {
    Triple<double> a, b, c;
  };

  Corners corners(std::int32_t triangle) const noexcept;
  Box box_of(std::int32_t triangle) const noexcept;
  void build(std::int32_t begin, std::int32_t end);

  template <class Visit>
  bool any_touching(const Visit& visit, std::int32_t a, std::int32_t b) const;
  template <class Visit>
  bool any_touching_in_leaves(const Visit& visit, const Node& a, const Node& b) const;

  const mesh::Surface& surface_;
  std::vector<std::int32_t> order_;
  std::vector<Corners> faces_;  ///< in that order: a query reads them one after the other
  std::vector<Node> nodes_;
};

template <class Visit>
bool TriangleTree::any_touching_in_leaves(const Visit& visit, const Node& a, const Node& b) const {
  for (std::int32_t i = a.begin; i < a.begin + a.count; ++i)
    for (std::int32_t j = &a == &b ? i + 1 : b.begin; j < b.begin + b.count; ++j) {
      const auto [first, second] = std::pair(std::min(order_[i], order_[j]), std::max(order_[i], order_[j]));
      if (box_of(first).touches(box_of(second)) && visit(first, second)) return true;
    }
  return false;
}

template <class Visit>
bool TriangleTree::any_touching(const Visit& visit, std::int32_t a, std::int32_t b) const {
  const Node &first = nodes_[a], &second = nodes_[b];
  if (!first.box.touches(second.box)) return false;
  if (first.count > 0 && second.count > 0) return any_touching_in_leaves(visit, first, second);
  if (a == b)
    return any_touching(visit, a + 1, a + 1) || any_touching(visit, a + 1, first.right) ||
           any_touching(visit, first.right, first.right);
  if (second.count > 0) return any_touching(visit, a + 1, b) || any_touching(visit, first.right, b);
  return any_touching(visit, a, b + 1) || any_touching(visit, a, second.right);
}

}  // namespace talus::dem
