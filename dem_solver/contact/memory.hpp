#pragma once

#include <span>
#include <vector>

#include "dem_solver/collision/slot_move.hpp"
#include "dem_solver/particles/row.hpp"

namespace talus::dem {

/// What the contacts of one list remember, a slot each. Laws without memory have no store.
template <class Law, int rows = Law::memory_rows>
class ContactMemory {
 public:
  using Slot = typename Law::StoredMemory;

  void rebuild(Index slots, std::span<const SlotMove> moves) {
    std::vector<Slot> moved(static_cast<std::size_t>(slots));
    for (const SlotMove& move : moves) {
      moved[move.to] = slots_[move.from];
      if (move.reversed) Law::reverse(moved[move.to]);
    }
    slots_.swap(moved);
  }

  Slot recall(Index slot) const noexcept { return slots_[slot]; }
  void remember(Index slot, const Slot& memory) noexcept { slots_[slot] = memory; }
  /// Asks for a slot that is going to be needed.
  void fetch(Index slot) const noexcept { __builtin_prefetch(&slots_[slot], 1); }
  std::span<const Slot> all() const noexcept { return slots_; }

  /// The memory of four contacts as lanes.
  template <class Index4>
  TALUS_INLINE typename Law::template Memory<Lanes> lanes(const Index4& slot) const noexcept {
    typename Law::template Memory<Lanes> memory;
    for (int r = 0; r < rows; ++r)
      memory[r] = transposed(load(slots_[slot(0)][r]), load(slots_[slot(1)][r]), load(slots_[slot(2)][r]),
                             load(slots_[slot(3)][r]));
    return memory;
  }
  template <class Index4>
  TALUS_INLINE void store_lanes(const Index4& slot, int active,
                                const typename Law::template Memory<Lanes>& memory) noexcept {
    for (int r = 0; r < rows; ++r) {
      const Quad<Lanes> by_contact = transposed(memory[r].x, memory[r].y, memory[r].z, memory[r].w);
      const Lanes value[] = {by_contact.x, by_contact.y, by_contact.z, by_contact.w};
      for (int k = 0; k < active; ++k) store(slots_[slot(k)][r], value[k]);
    }
  }

  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor&& visit) {
    visit("memory", self.slots_);
  }

 private:
  std::vector<Slot> slots_;
};

template <class Law>
class ContactMemory<Law, 0> {
 public:
  using Slot = typename Law::StoredMemory;

  void rebuild(Index, std::span<const SlotMove>) noexcept {}
  Slot recall(Index) const noexcept { return {}; }
  void remember(Index, const Slot&) noexcept {}
  void fetch(Index) const noexcept {}
  template <class Index4>
  TALUS_INLINE typename Law::template Memory<Lanes> lanes(const Index4&) const noexcept {
    return {};
  }
  template <class Index4>
  TALUS_INLINE void store_lanes(const Index4&, int, const typename Law::template Memory<Lanes>&) noexcept {}
  template <class Self, class Visitor>
  static void visit_state(Self&, Visitor&&) {}
};

}  // namespace talus::dem
