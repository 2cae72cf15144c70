#pragma once

#include <span>
#include <vector>

#include "fem_solver/model/index.hpp"

namespace talus::fem {

/// Which node each node becomes when nodes of different parts closer than `tolerance` are joined: pairs in the order of
/// their distance, the nearest first, so that the order of the parts does not count; each node the lowest-numbered of
/// those it becomes one with. Two nodes of one part never do, not by a third between them either.
/// @param positions 3 a node (m). @param part_of the part of each node
std::vector<Index> weld_map(std::span<const double> positions, std::span<const Index> part_of,
                            double tolerance);

}  // namespace talus::fem
