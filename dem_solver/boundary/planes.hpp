#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "dem_solver/collision/slot_move.hpp"
#include "dem_solver/particles/spheres.hpp"

namespace talus::dem {

/// An infinite plane at rest; spheres are kept on the side its normal points to.
struct Plane {
  std::string name;
  Triple<double> point;   ///< m
  Triple<double> normal;  ///< unit
  Index material = 0;
};

/// The spheres near planes, sphere after sphere and plane after plane; a sphere and a plane share a slot for
/// their contact's memory.
class PlaneList {
 public:
  struct Entry {
    Index sphere = 0, plane = 0;
  };

  /// @param block_first spheres of block k: block_first[k] .. block_first[k + 1]
  /// @param new_place where the spheres of the previous list stand now.
  /// @return where the memory of each touching contact goes.
  std::vector<SlotMove> rebuild(std::span<const Plane> planes, const Spheres& spheres,
                                std::span<const Index> block_first, std::span<const Index> new_place,
                                double skin);

  /// Adds to each sphere the planes it touched at the last evaluation.
  void count_contacts(std::span<Index> contacts) const noexcept {
    for (std::size_t slot = 0; slot < entries_.size(); ++slot)
      contacts[entries_[slot].sphere] += touched_[slot];
  }

  std::span<const Entry> entries() const noexcept { return entries_; }
  /// Entries of the spheres of block k: block_first()[k] .. block_first()[k + 1].
  std::span<const Index> block_first() const noexcept { return block_first_; }
  Index block_count() const noexcept { return static_cast<Index>(block_first_.size()) - 1; }
  std::span<std::uint8_t> touched() noexcept { return touched_; }
  Index slots() const noexcept { return static_cast<Index>(entries_.size()); }

  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor&& visit) {
    visit("entries", self.entries_);
    visit("block_first", self.block_first_);
    visit("touched", self.touched_);
  }

 private:
  std::vector<Entry> entries_;
  std::vector<Index> block_first_{0, 0};
  std::vector<std::uint8_t> touched_;
};

/// m; of the sphere's centre above the plane.
TALUS_INLINE double height_above(const Plane& plane, const Row& position) noexcept {
  return dot(triple<double>(position) - plane.point, plane.normal);
}

}  // namespace talus::dem
