#pragma once

#include <functional>
#include <string>

#include "dem_solver/scene/ascii_grid.hpp"

namespace talus::dem {

/// Called with the number of a height in the order of the file, and what is wrong there; must not return.
using RefuseHeight = std::function<void(std::size_t height, const std::string& what)>;

/// Refuses heights that cannot be meant: voids that the header does not declare, heights in metres over a map in
/// degrees. Warns of a lowest or highest height that stands far apart from the rest.
void check_heights(const AsciiGrid& grid, const RefuseHeight& refuse);

}  // namespace talus::dem
