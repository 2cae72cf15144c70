#pragma once

#include <Eigen/Core>

#include "core/vector3.hpp"

namespace talus::dem {

using Matrix3 = Eigen::Matrix3d;

/// Volume, first and second moments of a body of density 1. They add up, so shapes are summed as moments and
/// turned into mass properties last.
struct VolumeMoments {
  double volume = 0;                            ///< m^3
  core::Vector3 first = core::Vector3::Zero();  ///< m^4; integral of x
  Matrix3 second = Matrix3::Zero();             ///< m^5; integral of x x^T

  VolumeMoments& operator+=(const VolumeMoments& other) {
    volume += other.volume;
    first += other.first;
    second += other.second;
    return *this;
  }
};

/// A rigid body's mass properties.
struct MassProperties {
  double mass = 0;                               ///< kg
  core::Vector3 centre = core::Vector3::Zero();  ///< m
  Matrix3 inertia = Matrix3::Zero();             ///< kg m^2; about the centre
};

/// I = density (tr(C) 1 - C) with C = second - volume centre centre^T. @pre moments.volume > 0
MassProperties mass_properties(const VolumeMoments& moments, double density);

}  // namespace talus::dem
