#include "fem_solver/scene/weld.hpp"

#include <algorithm>
#include <nanoflann.hpp>
#include <numeric>

namespace talus::fem {
namespace {

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
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointCloud>, PointCloud,
                                                 3, std::size_t>;

}  // namespace

std::vector<Index> weld_map(std::span<const double> positions, std::span<const Index> part_of,
                            double tolerance) {
  const PointCloud cloud{positions};
  Tree tree(3, cloud);
  tree.buildIndex();
  // nanoflann finds squared distances below the radius; a tolerance of zero still joins equal points.
  const double radius = std::max(tolerance * tolerance, 1e-300) * (1 + 1e-12);
  std::vector<Index> becomes(part_of.size());
  std::iota(becomes.begin(), becomes.end(), 0);
  std::vector<std::pair<std::size_t, double>> near;
  for (std::size_t i = 0; i < part_of.size(); ++i) {
    near.clear();
    tree.radiusSearch(&positions[3 * i], radius, near, nanoflann::SearchParams());
    for (const auto& [j, squared] : near)
      if (part_of[j] != part_of[i]) becomes[i] = std::min(becomes[i], becomes[std::min(i, j)]);
  }
  return becomes;
}

}  // namespace talus::fem
