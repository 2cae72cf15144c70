#pragma once

#include <nanoflann.hpp>
#include <span>

namespace talus::mesh {

/// Positions, 3 a point (m), as nanoflann's trees ask for them.
struct PointCloud {
  std::span<const double> positions;

  std::size_t kdtree_get_point_count() const { return positions.size() / 3; }
  double kdtree_get_pt(std::size_t point, std::size_t direction) const {
    return positions[3 * point + direction];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// Finds the points within a radius, whose square it is asked with.
using PointTree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointCloud>,
                                                      PointCloud, 3, std::size_t>;

}  // namespace talus::mesh
