#pragma once

#include <cstdint>

namespace talus::fem {

using Index = std::int32_t;

/// A run of consecutive elements, nodes or slots.
struct Range {
  Index begin = 0;
  Index end = 0;
};

}  // namespace talus::fem
