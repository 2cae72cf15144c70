#pragma once

#include <span>
#include <vector>

#include "dem_solver/boundary/boundary_list.hpp"

namespace talus::dem {

/// A feature that a sphere overlaps.
struct FeatureTouch {
  double distance = 0;    ///< m; from the centre to the feature's surface
  Triple<double> normal;  ///< unit vector to the centre
  Weights weights;
  Index feature = -1;
  double reach =
      0;  ///< m; distance at which the contact ends, as far as its saddle: the overlap is reach - distance
  FeatureSaddle saddle;  ///< that ends it; of feature -1: none, it ends where the sphere does
};

/// Room for the search, kept from one to the next.
class TouchSearch {
 public:
  explicit TouchSearch(std::size_t candidates = 0) { reserve(candidates); }
  void reserve(std::size_t candidates);

  /// The candidates that count as contacts, nearest first, one feature once. Sorting by distance makes the result
  /// independent of the order of the features.
  std::span<const FeatureTouch> find(const Boundary& boundary, const Row& sphere,
                                     std::span<const Index> candidates, ContactRule rule) noexcept;

 private:
  /// What two or more features share: a node, or the edge of two nodes.
  struct Shared {
    std::array<Index, 2> nodes{-1, -1};  ///< ascending; a single node twice
    Index touch = -1;                    ///< number of a feature that has it
  };
  /// Two touches whose features meet, and how high the way from one to the other is there.
  struct Link {
    double level = 0;  ///< m; the distance of the sphere's centre from what they share
    Index first = -1, second = -1;
    std::array<Index, 2> nodes{-1, -1};
  };

  void drop_those_beyond_tangent_planes() noexcept;
  void keep_local_minima(const Boundary& boundary, const Row& sphere) noexcept;
  bool is_only_minimum(const Boundary& boundary) const noexcept;
  void find_links(const Boundary& boundary, const Row& sphere) noexcept;
  void limit_by_saddles(const Boundary& boundary, const Row& sphere) noexcept;
  Index root_of(Index touch) noexcept;

  std::vector<FeatureTouch> touches_;
  std::vector<Shared> shared_;
  std::vector<Link> links_;
  std::vector<Index> parent_;
};

}  // namespace talus::dem
