#pragma once

#include <random>

#include "core/vector3.hpp"

namespace talus::tests {

/// Evenly distributed in the cube from -1 to 1.
inline core::Vector3 random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> in(-1, 1);
  return {in(random), in(random), in(random)};
}

}  // namespace talus::tests
