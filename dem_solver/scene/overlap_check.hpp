#pragma once

#include <functional>
#include <span>
#include <string>

#include "dem_solver/particles/spheres.hpp"

namespace talus::dem {

/// @throws ConfigError where spheres of different bodies overlap at time 0, with the deepest pair, its place
/// and depth: they would be blown apart.
/// @param name_of the body of a sphere, for the message; may be empty
void check_overlaps(std::span<const SphereInput> spheres,
                    const std::function<std::string(Index)>& name_of = {});

}  // namespace talus::dem
