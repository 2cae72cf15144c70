#pragma once

#include <string>
#include <vector>

#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// Parts that hang together, by name, and that no support holds anywhere: they would fall, or float, freely. One list
/// for each such piece of the structure. Slides join what they lead.
std::vector<std::vector<std::string>> unheld_parts(const Model& model);

}  // namespace talus::fem
