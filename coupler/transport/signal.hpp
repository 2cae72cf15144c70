#pragma once

#include <atomic>

#include "coupler/transport/layout.hpp"

/// Waiting until the other side has done its part. Docs: docs/coupling.md, "What a window costs".
namespace talus::coupler::transport {

/// Asks the scheduler to let this thread run soon after it is woken, also while others keep the cores busy: a
/// short time slice in exchange for an early turn. A window is a chain of wake-ups; each of them could
/// otherwise wait for the end of a slice of somebody else, some milliseconds. Kernels before 6.12 do not know
/// the request and leave things as they are.
void ask_for_early_turns() noexcept;

/// Longest sleep without a look around, so that a death is noticed within it.
inline constexpr double slice_seconds = 0.05;

/// True when posted, false after a slice. Sleeps, but for a moment before in which it offers the core to
/// others (`YieldingWait` in signal.cpp). Uses the monotonic clock: setting the machine's time does not
/// lengthen a wait.
bool wait_slice(Signal& signal) noexcept;

/// Sleeps until `signal` is posted. `look_around(seconds)` is called after every slice with the time slept
/// so far; it throws to give up. Time counts in slices slept, so that a process that was stopped (Ctrl-Z)
/// does not count its pause.
template <class LookAround>
void wait(Signal& signal, LookAround&& look_around) {
  for (int slices = 1; !wait_slice(signal); ++slices) look_around(slices * slice_seconds);
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
void post(Signal& signal) noexcept;

}  // namespace talus::coupler::transport
