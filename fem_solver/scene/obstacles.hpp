#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/fields.hpp"
#include "fem_solver/model/model.hpp"

/// The key `obstacles`: what stops nodes of the structure.
namespace talus::fem {

struct ObstaclePlaneScene {
  core::Vector3 point = core::Vector3::Zero();   ///< m
  core::Vector3 normal = core::Vector3::Zero();  ///< to the side where nodes may be
};
void describe(core::Fields& fields, ObstaclePlaneScene& plane);

struct ObstacleScene {
  std::string place;
  std::optional<ObstaclePlaneScene> plane;
  std::vector<std::string> nodes;   ///< node sets
  double distance = 0;              ///< m
  double friction = 0;              ///< 1
  std::optional<double> stiffness;  ///< N/m; absent: a tenth of what holds the node itself
};
void describe(core::Fields& fields, ObstacleScene& obstacle);

using NamedObstacle = std::pair<std::string, ObstacleScene>;

/// Adds an obstacle to the model, as a part. Nodes that supports hold in all directions are left out.
/// @pre elements, node sets and supports are there
/// @throws core::ConfigError where a node is behind it at the start, or no node is left
void add_obstacle(const NamedObstacle& obstacle, Model& model);

}  // namespace talus::fem
