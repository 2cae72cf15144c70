#pragma once

#include "dem_solver/particles/row.hpp"

namespace talus::dem {

/// A contact whose memory moves to another place when its list is rebuilt.
struct SlotMove {
  Index from = 0, to = 0;
  bool reversed = false;  ///< the partners changed places, and with them the signs
};

}  // namespace talus::dem
