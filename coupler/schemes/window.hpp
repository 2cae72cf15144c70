#pragma once

#include <array>
#include <cstdint>

namespace talus::coupler {

/// A stretch of time between two exchanges. Time is counted in integers and never accumulated: a window
/// begins `index` units after time 0 and is `units` long. A unit is the regular window of the scene, or that
/// cut in half a few times; halving is exact in binary arithmetic, so every window's start has the same bits
/// however it was reached ("halves of a window begin and end where the whole one does" in implicit_test.cpp).
struct Window {
  std::int64_t index = 0;
  double unit = 0;            ///< s
  std::int64_t halvings = 0;  ///< of the regular window that make a unit
  std::int64_t units = 1;     ///< more than one in free flight only

  double start() const { return static_cast<double>(index) * unit; }
  double length() const { return static_cast<double>(units) * unit; }
  /// s; of a window that is neither halved nor grown
  double regular_length() const { return unit * static_cast<double>(std::int64_t{1} << halvings); }
  /// The number of the regular window in which this one begins: the one that messages name.
  std::int64_t regular_index() const { return index >> halvings; }
  /// @pre units == 1
  std::array<Window, 2> halves() const {
    return {Window{.index = 2 * index, .unit = unit / 2, .halvings = halvings + 1},
            Window{.index = 2 * index + 1, .unit = unit / 2, .halvings = halvings + 1}};
  }
};

}  // namespace talus::coupler
