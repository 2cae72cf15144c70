#include "fem_solver/scene/weld.hpp"

#include <algorithm>
#include <numeric>

#include "fem_solver/model/joined_nodes.hpp"
#include "interface_mesh/point_tree.hpp"

namespace talus::fem {
namespace {

/// Nodes that become one, and the parts that each group is of.
class Welds {
 public:
  explicit Welds(std::span<const Index> part_of) : nodes_(part_of.size()) {
    for (const Index part : part_of) parts_.push_back({part});
  }
  Index of(Index node) { return nodes_.of(node); }
  /// Unless two nodes of one part would become one.
  void join(Index a, Index b) {
    const auto [into, from] = std::minmax({of(a), of(b)});
    auto &own = parts_[static_cast<std::size_t>(into)], &more = parts_[static_cast<std::size_t>(from)];
    if (into == from || std::ranges::find_first_of(own, more) != own.end()) return;
    own.insert(own.end(), more.begin(), more.end());
    nodes_.join(into, from);
  }

 private:
  JoinedNodes nodes_;
  std::vector<std::vector<Index>> parts_;
};

struct NearPair {
  double squared_distance;
  Index a, b;
  auto operator<=>(const NearPair&) const = default;
};

}  // namespace

std::vector<Index> weld_map(std::span<const double> positions, std::span<const Index> part_of,
                            double tolerance) {
  const mesh::PointCloud cloud{positions};
  mesh::PointTree tree(3, cloud);
  tree.buildIndex();
  // nanoflann finds squared distances below the radius; a tolerance of zero still joins equal points.
  const double radius = std::max(tolerance * tolerance, 1e-300) * (1 + 1e-12);
  std::vector<NearPair> pairs;
  std::vector<std::pair<std::size_t, double>> near;
  for (std::size_t i = 0; i < part_of.size(); ++i) {
    near.clear();
    tree.radiusSearch(&positions[3 * i], radius, near, nanoflann::SearchParams());
    for (const auto& [j, squared] : near)
      if (j > i && part_of[j] != part_of[i])
        pairs.push_back({squared, static_cast<Index>(i), static_cast<Index>(j)});
  }
  std::ranges::sort(pairs);
  Welds welds(part_of);
  for (const NearPair& pair : pairs) welds.join(pair.a, pair.b);
  std::vector<Index> becomes(part_of.size());
  for (std::size_t i = 0; i < becomes.size(); ++i) becomes[i] = welds.of(static_cast<Index>(i));
  return becomes;
}

}  // namespace talus::fem
