#pragma once

#include <algorithm>
#include <vector>

#include "dem_solver/boundary/boundary_list.hpp"

namespace talus::dem {

/// A feature that a sphere overlaps.
struct FeatureTouch {
  double distance = 0;    ///< m; from the centre to the feature's surface
  Triple<double> normal;  ///< unit vector to the centre
  Weights weights;
  Index feature = -1;
};

/// Those of the candidates that count as contacts: nearest first, one feature once.
///
/// A candidate is dropped where its contact point lies on or beyond the tangent plane of a nearer accepted
/// one,
///     n_new . n_old L_new >= L_old        n: unit vectors to the centre, L: distances of the contact points
///     from it
/// so a sphere on a shared edge or vertex, or whose cap reaches into the next coplanar triangle, feels one
/// contact. Sorting by distance makes the result independent of the order of the features. Test:
/// verification/particles "triangulated floor".
/// @param touches replaced; keeps its capacity.
inline void find_touching_features(const Boundary& boundary, const Row& sphere,
                                   std::span<const Index> candidates,
                                   std::vector<FeatureTouch>& touches) noexcept {
  constexpr double round_off =
      1e-9;  // shared points computed from two features differ by this much at most, relative to L
  touches.clear();
  const Triple<double> centre = triple<double>(sphere);
  for (Index k : candidates) {
    const Feature& feature = boundary.features()[k];
    const Boundary::ClosestPoint closest = boundary.closest(feature, centre);
    const Triple<double> out = centre - closest.point;
    const double axis_distance = length(out);
    const double distance = axis_distance - feature.wire_radius;
    if (distance >= sphere.w || axis_distance <= 0) continue;
    touches.push_back({distance, (1 / axis_distance) * out, closest.weights, k});
  }
  std::ranges::sort(touches, [](const FeatureTouch& a, const FeatureTouch& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.feature < b.feature;
  });
  std::size_t accepted = 0;
  for (std::size_t k = 0; k < touches.size(); ++k) {
    const bool repeats =
        std::any_of(touches.begin(), touches.begin() + accepted, [&](const FeatureTouch& nearer) {
          return dot(touches[k].normal, nearer.normal) * touches[k].distance >=
                 nearer.distance * (1 - round_off);
        });
    if (!repeats) touches[accepted++] = touches[k];
  }
  touches.resize(accepted);
}

}  // namespace talus::dem
