#pragma once

#include <span>
#include <vector>

#include "fem_solver/model/index.hpp"

namespace talus::fem {

/// Which node each node becomes when nodes of different parts closer than `tolerance` are joined: the
/// lowest-numbered one within reach, itself where there is none. Nodes of one part are never joined.
/// @param positions 3 a node (m). @param part_of the part of each node
std::vector<Index> weld_map(std::span<const double> positions, std::span<const Index> part_of,
                            double tolerance);

}  // namespace talus::fem
