#pragma once

#include <span>

#include "dem_solver/particles/spheres.hpp"

namespace talus::dem {

/// @throws ConfigError where spheres of different bodies overlap at time 0, with the deepest pair, its place
/// and depth: they would be blown apart.
void check_overlaps(std::span<const SphereInput> spheres);

}  // namespace talus::dem
