#include "coupler/transport/signal.hpp"

#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

namespace talus::coupler::transport {
namespace {

constexpr std::int64_t microsecond = 1000;  // ns

std::int64_t now() noexcept {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * 1'000'000'000 + time.tv_nsec;
}

/// About 10 ns in which a core that is one half of another leaves it to that half.
void rest_a_moment() noexcept {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

/// Takes the post if it is there or comes within about a microsecond: a look that writes nothing and enters
/// no kernel leaves the memory and the run queues to those who work.
bool try_take(Signal& signal) noexcept {
  for (int glance = 0, raised = 0; glance < 8; ++glance) {
    sem_getvalue(&signal.raised, &raised);
    if (raised > 0) break;
    rest_a_moment();
  }
  return sem_trywait(&signal.raised) == 0;
}

/// Looks for the post between yields of the core. A hand-over to a thread that is awake costs a fraction of
/// waking one that sleeps on an idle core. Where a post is seen late, somebody else uses the cores for work
/// of his own, and a yield gave him a whole time slice: then this thread sleeps through as many waits as
/// their wake-ups cost what was lost. So a busy machine costs at most twice what sleeping alone would.
class YieldingWait {
 public:
  bool take(Signal& signal) noexcept {
    if (asleep_for_ > 0) {
      --asleep_for_;
      return try_take(signal);
    }
    for (const std::int64_t start = now(); now() - start < longest_wait; sched_yield()) {
      if (!try_take(signal)) continue;
      judge(now() - load(signal.posted_at));
      return true;
    }
    return false;
  }

 private:
  static constexpr std::int64_t longest_wait = 100 * microsecond, longest_delay = 40 * microsecond,
                                cost_of_waking = 10 * microsecond, longest_rest = 512;

  void judge(std::int64_t delay) noexcept {
    if (delay > longest_delay) asleep_for_ = std::min(delay / cost_of_waking, longest_rest);
  }
  std::int64_t asleep_for_ = 0;  ///< waits
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

bool wait_slice(Signal& signal) noexcept {
  thread_local YieldingWait awake;
  bool taken = awake.take(signal);
  if (!taken) {
    const std::int64_t until = now() + static_cast<std::int64_t>(slice_seconds * 1e9);
    const timespec time{.tv_sec = until / 1'000'000'000, .tv_nsec = until % 1'000'000'000};
    do {
      taken = sem_clockwait(&signal.raised, CLOCK_MONOTONIC, &time) == 0;
    } while (!taken && errno == EINTR);
  }
  (void)load(signal.posted_at);  // acquires what the other side wrote before it posted
  return taken;
}

void post(Signal& signal) noexcept {
  store(signal.posted_at, now());
  sem_post(&signal.raised);
}

}  // namespace talus::coupler::transport
