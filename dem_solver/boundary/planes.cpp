#include "dem_solver/boundary/planes.hpp"

#include <algorithm>
#include <tuple>

namespace talus::dem {

namespace {

/// A contact that touched at the last evaluation, its sphere in the new place.
struct OldPlaneContact {
  Index sphere = 0, plane = 0, slot = 0;
};

std::vector<OldPlaneContact> old_plane_contacts(std::span<const PlaneList::Entry> entries,
                                                std::span<const std::uint8_t> touched,
                                                std::span<const Index> new_place) {
  std::vector<OldPlaneContact> old;
  for (std::size_t slot = 0; slot < entries.size(); ++slot)
    if (touched[slot])
      old.push_back({new_place[entries[slot].sphere], entries[slot].plane, static_cast<Index>(slot)});
  std::ranges::sort(old, {}, [](const OldPlaneContact& c) { return std::tuple(c.sphere, c.plane); });
  return old;
}

}  // namespace

std::vector<SlotMove> PlaneList::rebuild(std::span<const Plane> planes, const Spheres& spheres,
                                         std::span<const Index> block_first, std::span<const Index> new_place,
                                         double skin) {
  const std::vector<OldPlaneContact> old = old_plane_contacts(entries_, touched_, new_place);
  auto next = old.begin();
  std::vector<SlotMove> moves;
  entries_.clear();
  touched_.clear();
  block_first_.clear();
  for (Index i = 0; i < spheres.size(); ++i) {
    while (block_first[block_first_.size()] == i) block_first_.push_back(slots());
    const Row& p = spheres.position[i];
    for (Index k = 0; k < static_cast<Index>(planes.size()); ++k) {
      const bool touched = next != old.end() && next->sphere == i && next->plane == k;
      if (!touched && height_above(planes[k], p) >= p.w + skin) continue;
      if (touched) moves.push_back({(next++)->slot, slots()});
      entries_.push_back({i, k});
      touched_.push_back(touched);
    }
  }
  block_first_.resize(block_first.size(), slots());
  return moves;
}

}  // namespace talus::dem
