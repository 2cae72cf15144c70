#pragma once

#include <semaphore.h>

#include <atomic>
#include <cstdint>

/// Sleeping until the other side has done its part. Nobody spins: with three processes on two cores spinning
/// takes the core the other side needs.
namespace talus::coupler::transport {

/// Longest sleep without a look around, so that a death is noticed within it.
inline constexpr double slice_seconds = 0.05;

/// True when posted, false after a slice. Uses the monotonic clock: setting the machine's time does not
/// lengthen a wait.
bool wait_slice(sem_t& semaphore) noexcept;

/// Sleeps until `semaphore` is posted. `look_around(seconds)` is called after every slice with the time slept
/// so far; it throws to give up. Time counts in slices slept, so that a process that was stopped (Ctrl-Z)
/// does not count its pause.
template <class LookAround>
void wait(sem_t& semaphore, LookAround&& look_around) {
  for (int slices = 1; !wait_slice(semaphore); ++slices) look_around(slices * slice_seconds);
}

template <class T>
T load(const T& shared) noexcept {
  return std::atomic_ref<T>(const_cast<T&>(shared)).load(std::memory_order_acquire);
}
template <class T>
void store(T& shared, T value) noexcept {
  std::atomic_ref<T>(shared).store(value, std::memory_order_release);
}
/// Publishes everything written before it, then wakes the other side.
void post(sem_t& semaphore, std::uint64_t& counter) noexcept;

}  // namespace talus::coupler::transport
