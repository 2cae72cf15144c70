#include "dem_solver/collision/pair_list.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <numeric>

#include "core/parallel.hpp"
#include "dem_solver/collision/size_classes.hpp"

namespace talus::dem {

namespace {

/// Enough blocks to share among threads; fewer have fewer edges, whose spheres two blocks read.
constexpr Index most_blocks = 32;
constexpr Index fewest_slabs_a_block = 2;  // so that every second block is out of reach

/// Cuts the slabs into blocks of about equally many spheres. Their number is a power of two, so that the even
/// blocks, and the odd ones, can be shared evenly among 2, 4 or 8 threads.
std::vector<CellGrid::SlabBlock> cut_into_blocks(std::span<const Index> slab_of, Index slabs) {
  const Index blocks = std::min<Index>(
      most_blocks,
      static_cast<Index>(std::bit_floor(static_cast<unsigned>(std::max(1, slabs / fewest_slabs_a_block)))));
  std::vector<std::int64_t> up_to(static_cast<std::size_t>(slabs) + 1);  // spheres before each slab
  for (Index slab : slab_of) ++up_to[slab + 1];
  std::partial_sum(up_to.begin(), up_to.end(), up_to.begin());
  std::vector<CellGrid::SlabBlock> cut;
  for (Index k = 0, first = 0; k < blocks; ++k) {
    const Index left = blocks - 1 - k;
    Index end = std::min(first + fewest_slabs_a_block, slabs);
    while (end < slabs - left * fewest_slabs_a_block && up_to[end] * blocks < (k + 1) * up_to.back()) ++end;
    if (left == 0) end = slabs;
    cut.push_back({first, end - first});
    first = end;
  }
  return cut;
}

/// Spheres in the order of blocks and, within a block, in the order of their cells; equal cells keep the
/// present order.
struct SpatialOrder {
  std::vector<Index> order;        ///< order[new place] = old place
  std::vector<Index> block_first;  ///< in new places
  std::vector<Index> slab;         ///< of each old place
};

SpatialOrder spatial_order(const Spheres& spheres, double cell_size) {
  const CellGrid grid(spheres.position, cell_size);
  std::vector<Index> all(spheres.position.size()), cell_of(spheres.position.size());
  std::iota(all.begin(), all.end(), 0);
  SpatialOrder sorted;
  for (Index i : all) sorted.slab.push_back(grid.slab(grid.cell(spheres.position[i])));
  const std::vector<CellGrid::SlabBlock> blocks = cut_into_blocks(sorted.slab, grid.slab_count());
  std::vector<Index> block_of(static_cast<std::size_t>(grid.slab_count()));
  for (Index k = 0; k < static_cast<Index>(blocks.size()); ++k)
    std::fill_n(block_of.begin() + blocks[k].first, blocks[k].slabs, k);
  for (Index i : all)
    cell_of[i] = grid.number_in_block(grid.cell(spheres.position[i]), blocks[block_of[sorted.slab[i]]]);
  CellMembers members;
  members.fill(all, cell_of, grid.cell_count());
  for (const CellGrid::SlabBlock& block : blocks)
    sorted.block_first.push_back(members.first[block.first * grid.cells_a_slab()]);
  sorted.block_first.push_back(members.first.back());
  sorted.order = std::move(members.points);
  return sorted;
}

/// What one block found, to be put together in the order of the blocks.
struct BlockPairs {
  std::vector<Index> count;  ///< partners of each sphere of the block
  std::vector<Index> other;
  std::vector<PairList::WidePair> wide;
};

bool same_rock(const Spheres& spheres, Index i, Index j) noexcept {
  return spheres.in_rock(i) && spheres.rock[i] == spheres.rock[j];
}

BlockPairs search_block(const Spheres& spheres, const SizeClasses& classes, std::span<const Index> slab,
                        double skin, Index begin, Index end) {
  BlockPairs found;
  for (Index i = begin; i < end; ++i) {
    const Row& p = spheres.position[i];
    const std::size_t before = found.other.size();
    classes.visit_neighbours(p, i, [&](Index j) {
      const Row& q = spheres.position[j];
      const double dx = p.x - q.x, dy = p.y - q.y, dz = p.z - q.z, reach = p.w + q.w + skin;
      if (dx * dx + dy * dy + dz * dz >= reach * reach || same_rock(spheres, i, j)) return;
      if (std::abs(slab[i] - slab[j]) <= 1)
        found.other.push_back(j);
      else
        found.wide.push_back({i, j});
    });
    found.count.push_back(static_cast<Index>(found.other.size() - before));
  }
  return found;
}

/// Pairs that touched at the last evaluation, in the spheres' new places.
struct OldContact {
  Index first, second, slot;
};

std::vector<OldContact> old_contacts(const PairList& list, std::span<const Index> new_place) {
  std::vector<OldContact> old;
  const auto first = list.first();
  const auto keep = [&](Index a, Index b, Index slot) {
    if (list.touched()[slot]) old.push_back({new_place[a], new_place[b], slot});
  };
  for (Index i = 0; i + 1 < static_cast<Index>(first.size()); ++i)
    for (Index slot = first[i]; slot < first[i + 1]; ++slot) keep(i, list.other()[slot], slot);
  Index slot = static_cast<Index>(list.other().size());
  for (const PairList::WidePair& pair : list.wide()) keep(pair.first, pair.second, slot++);
  return old;
}

/// Where a pair is listed now; `to` is -1 where it is not.
SlotMove find_slot(const PairList& list, const OldContact& old) {
  const auto other = list.other();
  const auto wide = list.wide();
  for (const bool reversed : {false, true}) {
    const Index owner = reversed ? old.second : old.first, partner = reversed ? old.first : old.second;
    for (Index slot = list.first()[owner]; slot < list.first()[owner + 1]; ++slot)
      if (other[slot] == partner) return {old.slot, slot, reversed};
    auto pair = std::lower_bound(wide.begin(), wide.end(), owner,
                                 [](const PairList::WidePair& p, Index sphere) { return p.first < sphere; });
    for (; pair != wide.end() && pair->first == owner; ++pair)
      if (pair->second == partner)
        return {old.slot, static_cast<Index>(other.size()) + static_cast<Index>(pair - wide.begin()),
                reversed};
  }
  return {old.slot, -1, false};
}

}  // namespace

PairList::Rebuilt PairList::rebuild(Spheres& spheres, double skin, int threads) {
  SizeClasses classes(spheres, skin);
  SpatialOrder sorted = spatial_order(spheres, classes.main_cell());
  std::vector<Index> new_place(sorted.order.size());
  for (std::size_t i = 0; i < sorted.order.size(); ++i) new_place[sorted.order[i]] = static_cast<Index>(i);
  const std::vector<OldContact> old = old_contacts(*this, new_place);

  spheres.reorder(sorted.order);
  classes.build_cells(spheres);
  block_first_ = std::move(sorted.block_first);
  std::vector<Index> slab(sorted.slab.size());
  for (std::size_t i = 0; i < slab.size(); ++i) slab[i] = sorted.slab[sorted.order[i]];
  std::vector<BlockPairs> found(static_cast<std::size_t>(block_count()));
  core::parallel_tasks({block_count(), threads}, [&](std::int64_t k) {
    found[k] = search_block(spheres, classes, slab, skin, block_first_[k], block_first_[k + 1]);
  });

  first_.assign(1, 0);
  other_.clear();
  wide_.clear();
  for (const BlockPairs& part : found) {
    for (Index count : part.count) first_.push_back(first_.back() + count);
    other_.insert(other_.end(), part.other.begin(), part.other.end());
    wide_.insert(wide_.end(), part.wide.begin(), part.wide.end());
  }
  touched_.assign(other_.size() + wide_.size(), 0);

  std::vector<SlotMove> moves;
  for (const OldContact& contact : old) {
    const SlotMove move = find_slot(*this, contact);
    if (move.to < 0) continue;
    touched_[move.to] = 1;
    moves.push_back(move);
  }
  return {std::move(new_place), std::move(moves)};
}

}  // namespace talus::dem
