#include "coupler/transport/signal.hpp"

#include <cerrno>
#include <ctime>

namespace talus::coupler::transport {

bool wait_slice(sem_t& semaphore) noexcept {
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
