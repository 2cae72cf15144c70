#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bitset>
#include <cstddef>

#include "core/parallel.hpp"
#include "dem_solver/particles/row.hpp"

namespace talus::dem {

/// How far a thread of a sweep has come, for its neighbours to wait for.
class SweepProgress {
 public:
  enum Reached : int { nothing, last_is_prepared, first_has_interacted, last_has_interacted };

  void announce(Reached reached) noexcept {
    reached_.store(reached, std::memory_order_release);
    reached_.notify_all();
  }
  void wait_for(Reached wanted) const noexcept {
    for (int reached = nothing; (reached = reached_.load(std::memory_order_acquire)) < wanted;)
      reached_.wait(reached, std::memory_order_acquire);
  }

 private:
  alignas(64) std::atomic<int> reached_{nothing};
};

/// The neighbouring blocks that one thread of a sweep works on. They begin with an even one.
struct SweepStretch {
  Index begin = 0, end = 0;
  bool is_first = true, is_last = true;
};

inline SweepStretch stretch_of(core::TeamMember member, Index blocks) noexcept {
  const Index pairs = (blocks + 1) / 2, threads = std::min<Index>(member.size, pairs);
  if (member.rank >= threads) return {};
  const auto begin_of = [&](Index rank) { return std::min(blocks, 2 * (pairs * rank / threads)); };
  return {.begin = begin_of(member.rank),
          .end = begin_of(member.rank + 1),
          .is_first = member.rank == 0,
          .is_last = member.rank + 1 == threads};
}

inline constexpr Index most_sweep_blocks = 64;

/// What is done with each block, see sweep_blocks().
template <class Prepare, class Interact, class Finish>
struct BlockStages {
  const Prepare& prepare;
  const Interact& interact;
  const Finish& finish;
};

/// The part of a sweep that one thread does.
template <class Stages>
class StretchSweep {
 public:
  StretchSweep(const Stages& stages, const SweepStretch& stretch, SweepProgress* own)
      : stages_(stages), own_(own), stretch_(stretch) {}

  void run() {
    const auto [begin, end, is_first, is_last] = stretch_;
    if (begin == end) return;
    prepare_once(end - 1);
    own_->announce(SweepProgress::last_is_prepared);
    if (!is_first) own_[-1].wait_for(SweepProgress::last_is_prepared);
    interact_once(begin);
    own_->announce(SweepProgress::first_has_interacted);
    if (!is_last) {
      own_[1].wait_for(SweepProgress::first_has_interacted);
      interact_in_turn(end - 1);
      own_->announce(SweepProgress::last_has_interacted);
    }
    for (Index k = begin; k < end; ++k) {
      for_own(k - 1, k + 1, [this](Index j) { interact_in_turn(j); });
      if (k > begin || is_first) stages_.finish(k);
    }
    if (is_first) return;
    own_[-1].wait_for(SweepProgress::last_has_interacted);
    stages_.finish(begin);
  }

 private:
  template <class Work>
  void for_own(Index first, Index last, const Work& work) {
    for (Index k = std::max(first, stretch_.begin); k <= std::min(last, stretch_.end - 1); ++k) work(k);
  }
  void prepare_once(Index k) {
    if (!prepared_[k]) stages_.prepare(k);
    prepared_[k] = true;
  }
  void interact_once(Index k) {
    if (interacted_[k]) return;
    for_own(k - 1, k + 1, [this](Index j) { prepare_once(j); });
    stages_.interact(k);
    interacted_[k] = true;
  }
  /// After the even blocks beside it, where it is an odd one.
  void interact_in_turn(Index k) {
    for_own(k - 1, k + 1, [this](Index j) {
      if (j % 2 == 0) interact_once(j);
    });
    interact_once(k);
  }

  const Stages& stages_;
  SweepProgress* own_;  ///< beside those of the threads before and after
  SweepStretch stretch_;
  std::bitset<most_sweep_blocks> prepared_, interacted_;
};

/// Works through a row of blocks of which each interacts with itself and the two beside it, in a wave that
/// brings a block's memory to the processor once:
///
///     prepare(k)   before anything interacts with block k
///     interact(k)  may write to blocks k - 1, k and k + 1; of any three neighbours the even ones first
///     finish(k)    when blocks k - 1, k and k + 1 have interacted: nobody will look at block k again
///
/// Each thread goes through a stretch of neighbouring blocks, and begins with those that other threads wait
/// for. The order in which a block is written to does not depend on their number. @pre at most
/// most_sweep_blocks; the two even blocks beside an odd one write to different places of it, and odd ones
/// beside an even one likewise
template <class Prepare, class Interact, class Finish>
void sweep_blocks(const core::Tasks& blocks, const Prepare& prepare, const Interact& interact,
                  const Finish& finish) {
  constexpr int most_threads = most_sweep_blocks / 2;
  const BlockStages<Prepare, Interact, Finish> stages{prepare, interact, finish};
  std::array<SweepProgress, most_threads> progress;
  core::parallel_team(std::min(blocks.threads, most_threads), [&](core::TeamMember member) {
    const SweepStretch stretch = stretch_of(member, static_cast<Index>(blocks.count));
    StretchSweep(stages, stretch, &progress[static_cast<std::size_t>(member.rank)]).run();
  });
}

}  // namespace talus::dem
