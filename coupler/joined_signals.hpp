#pragma once

#include <array>
#include <csignal>
#include <cstdint>

namespace talus::coupler {

/// While a program takes part in a run, the signals that ask a run to end are the coupler's: it may get them
/// too (the group of a terminal or of a batch job gets them as a whole), decides, and tells. Only once the
/// coupler has ended the run do they end this program. Handlers that the program has set itself stay.
class SignalsLeftToCoupler {
 public:
  /// @param run_state Header::state of the run; outlives this
  explicit SignalsLeftToCoupler(const std::uint32_t& run_state);
  ~SignalsLeftToCoupler();
  SignalsLeftToCoupler(const SignalsLeftToCoupler&) = delete;
  SignalsLeftToCoupler& operator=(const SignalsLeftToCoupler&) = delete;

 private:
  static constexpr std::array signals_{SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2};
  std::array<struct sigaction, signals_.size()> before_{};
};

}  // namespace talus::coupler
