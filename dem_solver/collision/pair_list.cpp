#include "dem_solver/collision/pair_list.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <numeric>

#include "core/parallel.hpp"
#include "dem_solver/collision/block_sweep.hpp"
#include "dem_solver/collision/size_classes.hpp"

namespace talus::dem {

namespace {

constexpr Index fewest_layers_a_block =
    2 * CellGrid::layers_a_cell;  // so that every second block is out of reach

/// Time of a contact over that of a sphere; 1.5 to 2 by the time of blocks with few and with many of them.
constexpr std::int64_t work_of_contact = 2;

/// Ends of blocks of neighbouring layers, of about equal work. Their number is a power of two, so that they can
/// be shared evenly among 2, 4 or 8 threads.
std::vector<Index> cut_into_blocks(std::span<const std::int64_t> work_of_layer) {
  const auto layers = static_cast<Index>(work_of_layer.size());
  const auto most = static_cast<unsigned>(std::max(1, layers / fewest_layers_a_block));
  const Index blocks = std::min(most_sweep_blocks, static_cast<Index>(std::bit_floor(most)));
  const auto all = std::accumulate(work_of_layer.begin(), work_of_layer.end(), std::int64_t{0});
  std::vector<Index> ends;
  std::int64_t up_to = 0;  // work of the layers before `end`
  for (Index k = 0, end = 0; k < blocks; ++k) {
    const Index least = std::min(end + fewest_layers_a_block, layers);
    const Index most_end = layers - (blocks - 1 - k) * fewest_layers_a_block;
    while (end < least || (end < most_end && up_to * blocks < (k + 1) * all)) up_to += work_of_layer[end++];
    ends.push_back(k + 1 < blocks ? end : layers);
  }
  return ends;
}

/// Spheres in the order of blocks and, within a block, in the order of their cells; equal cells keep the
/// present order.
struct SpatialOrder {
  std::vector<Index> order;        ///< order[new place] = old place
  std::vector<Index> block_first;  ///< in new places
  std::vector<Index> layer;        ///< in new places
};

SpatialOrder spatial_order(const Spheres& spheres, std::span<const Index> contacts, double cell_size) {
  const CellGrid grid(spheres.position, cell_size);
  const std::size_t count = spheres.position.size();
  std::vector<Index> layer(count);
  std::vector<std::int64_t> work_of_layer(static_cast<std::size_t>(grid.layer_count()));
  for (std::size_t i = 0; i < count; ++i) {
    layer[i] = grid.layer(spheres.position[i]);
    work_of_layer[layer[i]] += 1 + (contacts.empty() ? 0 : work_of_contact * contacts[i]);
  }
  std::vector<CellGrid::LayerBlock> blocks, block_of;  // the latter of each layer
  Index begin = 0, cells = 0;
  for (const Index end : cut_into_blocks(work_of_layer)) {
    blocks.push_back(grid.block_of_layers(begin, end, cells));
    block_of.resize(static_cast<std::size_t>(end), blocks.back());
    cells += grid.cells_of(blocks.back());
    begin = end;
  }
  std::vector<Index> all(count), cell_of(count);
  std::iota(all.begin(), all.end(), 0);
  for (const Index i : all)
    cell_of[i] = grid.number_in_block(grid.cell(spheres.position[i]), block_of[layer[i]]);
  CellMembers members;
  members.fill(all, cell_of, cells);

  SpatialOrder sorted{.order = std::move(members.points)};
  for (const CellGrid::LayerBlock& block : blocks)
    sorted.block_first.push_back(members.first[block.cells_before]);
  sorted.block_first.push_back(members.first.back());
  for (const Index i : sorted.order) sorted.layer.push_back(layer[i]);
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

BlockPairs search_block(const Spheres& spheres, const SizeClasses& classes, std::span<const Index> layer,
                        double skin, Index begin, Index end) {
  BlockPairs found;
  for (Index i = begin; i < end; ++i) {
    const Row& p = spheres.position[i];
    const std::size_t before = found.other.size();
    classes.visit_neighbours(p, i, [&](Index j) {
      const Row& q = spheres.position[j];
      const double dx = p.x - q.x, dy = p.y - q.y, dz = p.z - q.z, reach = p.w + q.w + skin;
      if (dx * dx + dy * dy + dz * dz >= reach * reach || same_rock(spheres, i, j)) return;
      if (std::abs(layer[i] - layer[j]) <= CellGrid::layers_a_cell)
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

std::vector<SlotMove> moves_to(const PairList& list, std::span<const OldContact> old, int threads) {
  std::vector<SlotMove> moves(old.size());
  core::parallel_runs({static_cast<std::int64_t>(old.size()), threads}, [&](core::Block run) {
    for (auto k = run.begin; k < run.end; ++k) moves[k] = find_slot(list, old[k]);
  });
  std::erase_if(moves, [](const SlotMove& move) { return move.to < 0; });
  return moves;
}

}  // namespace

void PairList::count_contacts(std::span<Index> contacts) const noexcept {
  for (Index i = 0; i + 1 < static_cast<Index>(first_.size()); ++i)
    for (Index slot = first_[i]; slot < first_[i + 1]; ++slot) contacts[i] += touched_[slot];
}

PairList::Rebuilt PairList::rebuild(Spheres& spheres, const Search& search) {
  SizeClasses classes(spheres, search.skin);
  SpatialOrder sorted = spatial_order(spheres, search.contacts, classes.main_cell());
  std::vector<Index> new_place(sorted.order.size());
  for (std::size_t i = 0; i < sorted.order.size(); ++i) new_place[sorted.order[i]] = static_cast<Index>(i);
  const std::vector<OldContact> old = old_contacts(*this, new_place);

  spheres.reorder(sorted.order);
  classes.build_cells(spheres);
  block_first_ = std::move(sorted.block_first);
  std::vector<BlockPairs> found(static_cast<std::size_t>(block_count()));
  core::parallel_tasks({block_count(), search.threads}, [&](std::int64_t k) {
    found[k] =
        search_block(spheres, classes, sorted.layer, search.skin, block_first_[k], block_first_[k + 1]);
  });

  first_.assign(1, 0);
  other_.clear();
  wide_.clear();
  for (const BlockPairs& part : found) {
    for (const Index count : part.count) first_.push_back(first_.back() + count);
    other_.insert(other_.end(), part.other.begin(), part.other.end());
    wide_.insert(wide_.end(), part.wide.begin(), part.wide.end());
  }
  touched_.assign(other_.size() + wide_.size(), 0);
  std::vector<SlotMove> moves = moves_to(*this, old, search.threads);
  for (const SlotMove& move : moves) touched_[move.to] = 1;
  return {std::move(new_place), std::move(moves)};
}

}  // namespace talus::dem
