#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

/// Loops over many equal items on several threads, with results that are the same bits for any number of
/// threads.
///
/// Each item writes its own place only, so the order of items cannot matter. A sum is taken over blocks whose
/// length does not depend on the number of threads, then over the blocks in their order.
///
/// Processes that share cores should run with OMP_WAIT_POLICY=passive, so that waiting threads sleep; the
/// launcher of solvers sets it.
namespace talus::core {

/// Threads of the loops below, 1 until set. Not to be called inside of a loop.
void set_thread_count(int count);
int thread_count() noexcept;

/// A range of items [begin, end).
struct Block {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

/// Items of a block; long enough to hide the cost of handing it out, short enough to share a few thousand
/// items fairly.
inline constexpr std::int64_t default_block_length = 512;

inline std::int64_t block_count(std::int64_t items,
                                std::int64_t block_length = default_block_length) noexcept {
  return (items + block_length - 1) / block_length;
}
inline Block block_at(std::int64_t index, std::int64_t items,
                      std::int64_t block_length = default_block_length) noexcept {
  return {index * block_length, std::min(items, (index + 1) * block_length)};
}

/// Calls body(Block, block index) for every block of `items`. Blocks are dealt in order, one run of
/// neighbours to each thread, so that a thread keeps meeting the same memory. @pre body is noexcept in
/// effect: an exception that leaves it ends the program
template <class Body>
void parallel_blocks(std::int64_t items, Body&& body, std::int64_t block_length = default_block_length) {
  const std::int64_t blocks = block_count(items, block_length);
  if (thread_count() == 1 || blocks <= 1) {
    for (std::int64_t i = 0; i < blocks; ++i) body(block_at(i, items, block_length), i);
    return;
  }
#pragma omp parallel for schedule(static) num_threads(thread_count())
  for (std::int64_t i = 0; i < blocks; ++i) body(block_at(i, items, block_length), i);
}

/// Calls body(item) for every item.
template <class Body>
void parallel_for(std::int64_t items, Body&& body) {
  parallel_blocks(items, [&](Block block, std::int64_t) {
    for (std::int64_t i = block.begin; i < block.end; ++i) body(i);
  });
}

/// Tasks of a loop and the threads that share them.
struct Tasks {
  std::int64_t count = 0;
  int threads = 1;
};

/// Calls work(context, task) for every task; threads take the next one as they become free. One thread is a
/// plain loop: an OpenMP region of one thread costs as much as all contacts of a small scene.
void run_tasks(const Tasks& tasks, const void* context, void (*work)(const void*, std::int64_t));

/// Calls body(task) for every task, for tasks of unequal length. @pre body is noexcept in effect
template <class Body>
void parallel_tasks(const Tasks& tasks, const Body& body) {
  run_tasks(tasks, &body, [](const void* of, std::int64_t task) { (*static_cast<const Body*>(of))(task); });
}

/// Calls body(Block) for as many runs of neighbouring items as there are threads.
template <class Body>
void parallel_runs(const Tasks& items, const Body& body) {
  const std::int64_t length = std::max<std::int64_t>(1, block_count(items.count, items.threads));
  parallel_tasks({block_count(items.count, length), items.threads},
                 [&](std::int64_t run) { body(block_at(run, items.count, length)); });
}

/// One of the threads that work on something at the same time, and may therefore wait for each other.
struct TeamMember {
  int rank = 0, size = 1;
};

/// Calls work(context, member) on at most so many threads at once. @pre work is noexcept in effect
void run_team(int threads, const void* context, void (*work)(const void*, TeamMember));

/// Calls body(member) on at most so many threads at once.
template <class Body>
void parallel_team(int threads, const Body& body) {
  run_team(threads, &body,
           [](const void* of, TeamMember member) { (*static_cast<const Body*>(of))(member); });
}

/// The sum of term(item), the same bits for any number of threads. Keeps its memory between sums; reserve()
/// before a loop that must not allocate.
template <class Value = double>
class OrderedSum {
 public:
  void reserve(std::int64_t items) { partial_.resize(static_cast<std::size_t>(block_count(items))); }

  template <class Term>
  Value operator()(std::int64_t items, Value zero, Term&& term) {
    return of_blocks(items, zero, [&](Block block) {
      Value sum = zero;
      for (std::int64_t i = block.begin; i < block.end; ++i) sum += term(i);
      return sum;
    });
  }

  /// The same where a block knows a faster way: term(block) is its sum.
  template <class Term>
  Value of_blocks(std::int64_t items, Value zero, Term&& term) {
    reserve(items);
    parallel_blocks(items, [&](Block block, std::int64_t index) {
      partial_[static_cast<std::size_t>(index)] = term(block);
    });
    Value total = zero;
    for (const Value& sum : partial_) total += sum;
    return total;
  }

 private:
  std::vector<Value> partial_;
};

}  // namespace talus::core
