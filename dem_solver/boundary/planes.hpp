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

/// The spheres near each plane; a sphere and a plane share a slot for their contact's memory.
class PlaneList {
 public:
  struct Entry {
    Index sphere = 0, plane = 0;
  };

  /// @param new_place where the spheres of the previous list stand now.
  /// @return where the memory of each touching contact goes.
  std::vector<SlotMove> rebuild(std::span<const Plane> planes, const Spheres& spheres,
                                std::span<const Index> new_place, double skin);

  std::span<const Entry> entries() const noexcept { return entries_; }
  /// Entries of plane k: first()[k] .. first()[k + 1]; a sphere stands there once.
  std::span<const Index> first() const noexcept { return first_; }
  std::span<std::uint8_t> touched() noexcept { return touched_; }
  Index slots() const noexcept { return static_cast<Index>(entries_.size()); }

  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor&& visit) {
    visit("entries", self.entries_);
    visit("first", self.first_);
    visit("touched", self.touched_);
  }

 private:
  std::vector<Entry> entries_;
  std::vector<Index> first_{0};
  std::vector<std::uint8_t> touched_;
};

/// m; of the sphere's centre above the plane.
TALUS_INLINE double height_above(const Plane& plane, const Row& position) noexcept {
  return dot(triple<double>(position) - plane.point, plane.normal);
}

}  // namespace talus::dem
