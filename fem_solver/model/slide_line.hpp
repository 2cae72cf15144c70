#pragma once

#include <span>
#include <vector>

#include "fem_solver/model/index.hpp"

namespace talus::fem {

/// A rope of other elements and the nodes that slide along it.
struct SlideLine {
  std::vector<Index> rope;     ///< nodes in their order along it
  std::vector<Index> sliders;  ///< none of them a node of the rope
};

}  // namespace talus::fem
