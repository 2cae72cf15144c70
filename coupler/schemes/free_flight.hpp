#pragma once

#include <cstdint>

#include "coupler/schemes/exchange.hpp"

namespace talus::coupler {

/// What free flight spared and cost.
struct FlightTally {
  std::int64_t windows = 0;     ///< that were grown
  std::int64_t regular = 0;     ///< windows that these took the place of
  std::int64_t taken_back = 0;  ///< windows in which something touched after all
  std::int64_t longest = 0;     ///< in regular windows
  void archive(core::StateArchive& archive);
};

/// Windows that grow while nothing touches and shrink before something does.
///
/// Without forces the two sides do not hear of each other, so a window of any length is exact, whatever the
/// scheme: the structure goes first, without forces, the particles then move against the boundary's motion
/// between the window's ends, each side in its own steps. A window in which they touch is taken back and
/// tried at half its length, down to the regular window, which is the scheme's. So contact begins in the same
/// step as with regular windows throughout ("windows that grow in free flight find ..." in
/// free_flight_test.cpp), as long as the boundary moves in a straight line over a window, which is why the
/// scene bounds their length.
class FreeFlight {
 public:
  /// @param longest window, in regular ones; at least two
  FreeFlight(Exchange& exchange, std::int64_t longest) : exchange_(exchange), longest_(longest) {}

  /// Computes a window that begins where this regular one does and is at most `most` of them long.
  /// @returns how many it took the place of; 0 where the scheme has to compute the regular window
  std::int64_t compute(const Window& regular, std::int64_t most);
  const FlightTally& tally() const { return tally_; }
  /// What later windows depend on.
  void archive(core::StateArchive& archive);

 private:
  bool is_free(const Window& window);
  void count(std::int64_t units);

  Exchange& exchange_;
  std::int64_t longest_;
  std::int64_t next_ = first_try;  ///< length of the next window to try, in regular ones
  FlightTally tally_;
  static constexpr std::int64_t first_try = 2;
};

}  // namespace talus::coupler
