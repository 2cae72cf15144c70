#pragma once

#include "core/vector3.hpp"
#include "dem_solver/particles/row.hpp"

namespace talus::dem {

/// From the reader's vectors to the solver's.
inline Triple<double> triple_of(const core::Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace talus::dem
