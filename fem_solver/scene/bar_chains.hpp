#pragma once

#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// Bars turn freely at their nodes. Where nothing but one or two bars without prestress meets a node that is free in
/// all directions, and the bars go on from there, nothing holds it sideways: a chain of bars pressed from its ends
/// folds up, however stiff the bars are.
/// @throws core::ConfigError naming the first such node
void refuse_folding_chains(const Model& model);

}  // namespace talus::fem
