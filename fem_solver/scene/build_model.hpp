#pragma once

#include "fem_solver/model/model.hpp"
#include "fem_solver/scene/structure_scene.hpp"

namespace talus::fem {

/// The structure a scene describes: shapes meshed, parts welded, sets resolved, masses lumped.
/// @throws core::ConfigError for geometry that cannot be computed with (zero lengths, dangling nodes), sets
/// that do not exist, and nodes without mass; with the part, the entity and its coordinates
Model build_model(const StructureScene& scene);

}  // namespace talus::fem
