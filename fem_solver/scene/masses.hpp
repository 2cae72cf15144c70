#pragma once

#include "fem_solver/model/model.hpp"
#include "fem_solver/scene/structure_scene.hpp"

namespace talus::fem {

/// Weight and mass damping of every node: of each part its own, where the scene gives it any, of point masses the
/// structure's. Inertia is the model's already (node_masses).
/// @param point_masses kg, of each node
void weigh_and_damp(const StructureScene& scene, std::span<const double> point_masses, Model& model);

/// A bar between a node that is held and its head, such as a post on its foot, turns about the foot: a third of its
/// mass moves with the head (m L^2/3), not the half that it weighs there. Bars that go on at the head as bars of the
/// same part keep their halves, which is what waves along them need.
void let_held_bars_turn(Model& model);

}  // namespace talus::fem
