#pragma once

#include <cstdint>

namespace talus::fem {

using Index = std::int32_t;

}  // namespace talus::fem
