#pragma once

#include <omp.h>

#include <span>

#include "fem_solver/model/index.hpp"

namespace talus::fem {

/// Runs loops on a fixed number of threads. Work is cut into blocks whose borders depend on the count alone,
/// never on the number of threads, so that sums over blocks have the same bits for any team.
class Team {
 public:
  static constexpr Index block_size = 1024;
  static constexpr Index blocks(Index count) { return (count + block_size - 1) / block_size; }

  explicit Team(int threads = 1) : threads_(threads) {}
  int threads() const { return threads_; }

  /// work(Range) for every block of 0..count. @pre work does not throw and blocks write to disjoint places.
  template <class Work>
  void run(Index count, const Work& work) const {
    const Index n = blocks(count);
    if (threads_ == 1 || n == 1) {
      for (Index block = 0; block < n; ++block) work(range(block, count));
      return;
    }
#pragma omp parallel for schedule(static) num_threads(threads_)
    for (Index block = 0; block < n; ++block) work(range(block, count));
  }

  /// The sum of work(Range) over the blocks, in their order. @pre partial.size() >= blocks(count)
  template <class Work>
  double sum(Index count, std::span<double> partial, const Work& work) const {
    run(count, [&](Range r) { partial[static_cast<std::size_t>(r.begin / block_size)] = work(r); });
    double total = 0;
    for (Index block = 0; block < blocks(count); ++block) total += partial[static_cast<std::size_t>(block)];
    return total;
  }

 private:
  static constexpr Range range(Index block, Index count) {
    const Index begin = block * block_size;
    return {begin, begin + block_size < count ? begin + block_size : count};
  }
  int threads_;
};

}  // namespace talus::fem
