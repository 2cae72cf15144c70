#include "dem_solver/boundary/planes.hpp"

namespace talus::dem {

std::vector<SlotMove> PlaneList::rebuild(std::span<const Plane> planes, const Spheres& spheres,
                                         std::span<const Index> new_place, double skin) {
  // slot_of[plane][sphere] would be large and thin; one plane at a time it is a single array.
  std::vector<Index> old_slot(static_cast<std::size_t>(spheres.size()));
  std::vector<Entry> entries;
  std::vector<Index> first{0};
  std::vector<std::uint8_t> touched;
  std::vector<SlotMove> moves;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    old_slot.assign(old_slot.size(), -1);
    if (k + 1 < first_.size())
      for (Index slot = first_[k]; slot < first_[k + 1]; ++slot)
        if (touched_[slot]) old_slot[new_place[entries_[slot].sphere]] = slot;
    for (Index i = 0; i < spheres.size(); ++i) {
      const Row& p = spheres.position[i];
      if (height_above(planes[k], p) >= p.w + skin && old_slot[i] < 0) continue;
      if (old_slot[i] >= 0) moves.push_back({old_slot[i], static_cast<Index>(entries.size())});
      entries.push_back({i, static_cast<Index>(k)});
      touched.push_back(old_slot[i] >= 0);
    }
    first.push_back(static_cast<Index>(entries.size()));
  }
  entries_.swap(entries);
  first_.swap(first);
  touched_.swap(touched);
  return moves;
}

}  // namespace talus::dem
