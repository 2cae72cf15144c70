#include "coupler/transport/signal.hpp"

#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <ctime>

namespace talus::coupler::transport {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::microseconds;

/// Looks for the post between yields of the core. A hand-over to a thread that is awake costs a fraction of
/// waking one that sleeps on an idle core. Where a yield takes long, somebody else uses the core for work of
/// his own, and each yield gives him a whole time slice: then this thread goes to sleep at once, for twice as
/// many waits each time it happens again.
class YieldingWait {
 public:
  bool take(sem_t& semaphore) noexcept {
    if (asleep_for_ > 0) {
      --asleep_for_;
      return sem_trywait(&semaphore) == 0;
    }
    const auto start = Clock::now();
    for (auto before = start;;) {
      if (sem_trywait(&semaphore) == 0) {
        next_rest_ = std::max(first_rest, next_rest_ - 1);
        return true;
      }
      sched_yield();
      const auto now = Clock::now();
      if (now - before > longest_yield) return back_off(semaphore);
      if (now - start > longest_wait) return false;
      before = now;
    }
  }

 private:
  static constexpr microseconds longest_wait{100}, longest_yield{40};
  static constexpr int first_rest = 256, longest_rest = 1 << 16;

  bool back_off(sem_t& semaphore) noexcept {
    asleep_for_ = next_rest_;
    next_rest_ = std::min(2 * next_rest_, longest_rest);
    return sem_trywait(&semaphore) == 0;
  }
  int asleep_for_ = 0, next_rest_ = first_rest;
};

/// The kernel's struct sched_attr (sched_setattr(2)), first version; Debian 12 has no header for it that goes
/// with <sched.h>.
struct SchedulingRequest {
  std::uint32_t size = sizeof(SchedulingRequest);
  std::uint32_t policy = SCHED_OTHER;
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t slice_nanoseconds = 100'000;  // the shortest there is
  std::uint64_t deadline = 0, period = 0;
};
static_assert(sizeof(SchedulingRequest) == 48);

}  // namespace

void ask_for_early_turns() noexcept {
  if (sched_getscheduler(0) != SCHED_OTHER) return;  // the user chose another policy
  SchedulingRequest request;
  errno = 0;
  request.nice = getpriority(PRIO_PROCESS, 0);
  if (errno == 0) syscall(SYS_sched_setattr, 0, &request, 0);
}

bool wait_slice(sem_t& semaphore) noexcept {
  thread_local YieldingWait awake;
  if (awake.take(semaphore)) return true;
  timespec until{};
  clock_gettime(CLOCK_MONOTONIC, &until);
  until.tv_nsec += static_cast<long>(slice_seconds * 1e9);
  until.tv_sec += until.tv_nsec / 1'000'000'000;
  until.tv_nsec %= 1'000'000'000;
  while (sem_clockwait(&semaphore, CLOCK_MONOTONIC, &until) != 0) {
    if (errno != EINTR) return false;
  }
  return true;
}

void post(sem_t& semaphore, std::uint64_t& counter) noexcept {
  std::atomic_ref<std::uint64_t>(counter).fetch_add(1, std::memory_order_release);
  sem_post(&semaphore);
}

}  // namespace talus::coupler::transport
