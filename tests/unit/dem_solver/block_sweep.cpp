#include "dem_solver/collision/block_sweep.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <vector>

namespace {

using namespace talus;
using dem::Index;

/// A row of blocks that notes who came by. Each block has two margins, which different neighbours write to,
/// and a middle.
class Diary {
 public:
  explicit Diary(Index blocks) : blocks_(static_cast<std::size_t>(blocks)) {}

  void sweep(int threads) {
    dem::sweep_blocks(
        {size(), threads}, [&](Index k) { prepare(k); }, [&](Index k) { interact(k); },
        [&](Index k) { finish(k); });
  }

  std::vector<std::vector<Index>> visitors() const {
    std::vector<std::vector<Index>> all;
    for (const Block& block : blocks_)
      for (const auto& part : {block.low, block.middle, block.high}) all.push_back(part);
    return all;
  }
  bool every_block_was_finished_once() const {
    return std::ranges::all_of(blocks_, [](const Block& block) { return block.finished == 1; });
  }
  bool rules_were_kept() const { return rules_were_kept_; }

 private:
  struct Block {
    std::vector<Index> low, middle, high;
    std::atomic<int> prepared{0}, interacted{0}, finished{0};
  };

  Index size() const { return static_cast<Index>(blocks_.size()); }
  template <class Check>
  bool holds_around(Index k, const Check& check) const {
    for (Index j = std::max(0, k - 1); j <= std::min(size() - 1, k + 1); ++j)
      if (!check(blocks_[j])) return false;
    return true;
  }
  void prepare(Index k) { expect(blocks_[k].prepared++ == 0 && blocks_[k].interacted == 0); }
  void interact(Index k) {
    expect(holds_around(k, [](const Block& block) { return block.prepared == 1 && block.finished == 0; }));
    if (k > 0) blocks_[k - 1].high.push_back(k);
    for (auto* part : {&blocks_[k].low, &blocks_[k].middle, &blocks_[k].high}) part->push_back(k);
    if (k + 1 < size()) blocks_[k + 1].low.push_back(k);
    expect(blocks_[k].interacted++ == 0);
  }
  void finish(Index k) {
    expect(holds_around(k, [](const Block& block) { return block.interacted == 1; }));
    ++blocks_[k].finished;
  }
  void expect(bool kept) {
    if (!kept) rules_were_kept_ = false;
  }

  std::vector<Block> blocks_;
  std::atomic<bool> rules_were_kept_{true};
};

}  // namespace

TEST_CASE("A sweep prepares, interacts and finishes every block once and in turn, on any number of threads") {
  for (const Index blocks : {1, 2, 3, 4, 5, 7, 8, 13, 64})
    for (const int threads : {1, 2, 3, 5, 40})
      for (int repetition = 0; repetition < 10; ++repetition) {
        Diary diary(blocks);
        diary.sweep(threads);
        INFO(blocks << " blocks, " << threads << " threads");
        REQUIRE(diary.rules_were_kept());
        REQUIRE(diary.every_block_was_finished_once());
      }
}

TEST_CASE("Every place of a block is written to by even blocks first, whatever the number of threads") {
  Diary one(16);
  one.sweep(1);
  for (const auto& visitors : one.visitors())
    CHECK(std::ranges::is_partitioned(visitors, [](Index k) { return k % 2 == 0; }));
  for (const int threads : {2, 3, 8}) {
    Diary several(16);
    several.sweep(threads);
    CHECK(several.visitors() == one.visitors());
  }
}
