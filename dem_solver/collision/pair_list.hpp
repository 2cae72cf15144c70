#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "dem_solver/collision/grid.hpp"
#include "dem_solver/collision/slot_move.hpp"
#include "dem_solver/particles/spheres.hpp"

namespace talus::dem {

/// All pairs of spheres nearer than a skin, found by a grid a size class, so that 1 : 100 in size costs no
/// more than equal sizes.
///
/// Every pair has a slot, where its contact law keeps its memory. The spheres are sorted into blocks of layers,
/// two cells thick or more and of about equal work; a pair belongs to one of its spheres, its owner, and
/// reaches no further than a cell. Of every second block no two therefore write to the same sphere, and forces
/// may be added in place, by any number of threads, in an order that does not depend on it (sweep_blocks). The
/// few pairs that reach further (a boulder among sand) come last, one after the other.
class PairList {
 public:
  struct WidePair {
    Index first = 0, second = 0;
  };
  struct Rebuilt {
    std::vector<Index> new_place;  ///< new_place[old place] of every sphere
    std::vector<SlotMove> moves;   ///< where the memory of each touching pair goes
  };

  struct Search {
    double skin = 0;  ///< m
    int threads = 1;
    /// Of each sphere at the last evaluation, to cut blocks of equal work; empty: not known.
    std::span<const Index> contacts{};
  };
  /// Sorts `spheres` in space and finds all pairs with surfaces nearer than the skin.
  Rebuilt rebuild(Spheres& spheres, const Search& search);

  /// Adds to each sphere the pairs it owns that touched at the last evaluation.
  void count_contacts(std::span<Index> contacts) const noexcept;

  Index slots() const noexcept { return static_cast<Index>(touched_.size()); }
  Index block_count() const noexcept { return static_cast<Index>(block_first_.size()) - 1; }
  /// Spheres of block k: block_first()[k] .. block_first()[k + 1]
  std::span<const Index> block_first() const noexcept { return block_first_; }
  core::Block places(Index block) const noexcept { return {block_first_[block], block_first_[block + 1]}; }
  /// Partners of sphere i: other()[first()[i]] .. other()[first()[i + 1]]; the place is the slot.
  std::span<const Index> first() const noexcept { return first_; }
  std::span<const Index> other() const noexcept { return other_; }
  /// Wide pairs; their slots follow those of other().
  std::span<const WidePair> wide() const noexcept { return wide_; }
  /// Whether the pair of each slot touched at the last evaluation. Written by the evaluation.
  std::span<std::uint8_t> touched() noexcept { return touched_; }
  std::span<const std::uint8_t> touched() const noexcept { return touched_; }

  /// Calls visit(array) for each array of the state.
  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor&& visit) {
    visit("block_first", self.block_first_);
    visit("first", self.first_);
    visit("other", self.other_);
    visit("wide", self.wide_);
    visit("touched", self.touched_);
  }

 private:
  std::vector<Index> block_first_{0, 0};
  std::vector<Index> first_{0};
  std::vector<Index> other_;
  std::vector<WidePair> wide_;
  std::vector<std::uint8_t> touched_;
};

}  // namespace talus::dem
