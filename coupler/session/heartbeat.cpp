#include "coupler/session/heartbeat.hpp"

#include <atomic>

#include "coupler/pause.hpp"

namespace talus::coupler {

Heartbeat::Heartbeat(std::uint64_t& beats)
    : thread_([&beats](const std::stop_token& stop) {
        do {
          std::atomic_ref(beats).fetch_add(1, std::memory_order_relaxed);
        } while (paused(stop, std::chrono::milliseconds(500)));
      }) {}

}  // namespace talus::coupler
