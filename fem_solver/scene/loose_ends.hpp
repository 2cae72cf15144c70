#pragma once

#include <string>
#include <vector>

#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// Ends of lines that hang beside a node and are joined with nothing: nearer to it than a twentieth of their last
/// element. Each a sentence with both, and how far apart they are. Ends that a support holds are meant.
std::vector<std::string> loose_ends(const Model& model);

}  // namespace talus::fem
