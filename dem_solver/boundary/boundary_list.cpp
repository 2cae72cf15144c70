#include "dem_solver/boundary/boundary_list.hpp"

#include <algorithm>

namespace talus::dem {

namespace {

/// Surface distance of a sphere's centre to a feature, m.
double distance_to(const Boundary& boundary, const Feature& feature, const Row& sphere) noexcept {
  const Triple<double> centre = triple<double>(sphere);
  return length(centre - boundary.closest(feature, centre).point) - feature.wire_radius;
}

}  // namespace

std::vector<SlotMove> BoundaryList::rebuild(const Boundary& boundary, const Spheres& spheres,
                                            std::span<const Index> new_place, double skin) {
  const double margin = grid_margin_in_skins * skin;
  const auto now = boundary.displacement();
  if (gridded_displacement_.empty() || boundary.motion_bound(gridded_displacement_) > margin) {
    grid_.build(boundary, margin);
    gridded_displacement_.assign(now.begin(), now.end());
  }
  std::vector<Index> old_entry(static_cast<std::size_t>(spheres.size()), -1);
  for (std::size_t k = 0; k < spheres_.size(); ++k) old_entry[new_place[spheres_[k]]] = static_cast<Index>(k);

  BoundaryList next;
  std::vector<SlotMove> moves;
  std::vector<Index> near;
  for (Index i = 0; i < spheres.size(); ++i) {
    const Row& p = spheres.position[i];
    grid_.near(p, p.w + skin, near);
    const auto begin = static_cast<Index>(next.candidates_.size());
    for (Index k : near)
      if (!boundary.is_lost(k) && distance_to(boundary, boundary.features()[k], p) < p.w + skin)
        next.candidates_.push_back(k);
    if (static_cast<Index>(next.candidates_.size()) == begin) continue;

    next.spheres_.push_back(i);
    next.first_.push_back(static_cast<Index>(next.candidates_.size()));
    next.contacts_.resize(next.candidates_.size());
    const Index old = old_entry[i];
    // A contact is a candidate still: it was within the skin.
    const Index kept = old < 0 ? 0 : std::min(count_[old], next.first_.back() - begin);
    for (Index c = 0; c < kept; ++c) {
      next.contacts_[begin + c] = contacts_[first_[old] + c];
      moves.push_back({first_[old] + c, begin + c});
    }
    next.count_.push_back(kept);
  }
  spheres_.swap(next.spheres_);
  first_.swap(next.first_);
  candidates_.swap(next.candidates_);
  count_.swap(next.count_);
  contacts_.swap(next.contacts_);
  listed_displacement_.assign(now.begin(), now.end());
  listed_losses_ = boundary.losses();
  return moves;
}

Index BoundaryList::most_candidates() const noexcept {
  Index most = 0;
  for (std::size_t k = 0; k + 1 < first_.size(); ++k) most = std::max(most, first_[k + 1] - first_[k]);
  return most;
}

}  // namespace talus::dem
