#pragma once

#include <string>
#include <vector>

#include "fem_solver/model/model.hpp"
#include "fem_solver/scene/conditions.hpp"

namespace talus::fem {

/// The nodes a selection means, in the order of the named set, or ascending.
/// @throws core::ConfigError naming the place, with the nearest known set, the nearest node, or how many
/// nodes a box missed by
std::vector<Index> select_nodes(const Model& model, const NodeSelection& selection);

/// The node set of this name. @throws core::ConfigError with the nearest known name
const std::vector<Index>& find_node_set(const Model& model, const std::string& place,
                                        const std::string& name);

}  // namespace talus::fem
