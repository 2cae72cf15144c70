#pragma once

#include <Eigen/Core>

namespace talus::core {

/// A point, velocity or force in space. Arrays of many are flat spans of 3 n doubles, x y z of each in turn.
using Vector3 = Eigen::Vector3d;

}  // namespace talus::core
