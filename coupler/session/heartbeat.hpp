#pragma once

#include <cstdint>
#include <thread>

namespace talus::coupler {

/// Tells participants that the coupler lives, whatever it does: a thread that counts up twice a second. A
/// stopped process stops counting.
class Heartbeat {
 public:
  /// @param beats Header::heartbeat; outlives this
  explicit Heartbeat(std::uint64_t& beats);

 private:
  std::jthread thread_;
};

}  // namespace talus::coupler
