#pragma once

#include <span>

#include "dem_solver/rocks/mass_properties.hpp"

namespace talus::dem {

struct Ball {
  core::Vector3 centre = core::Vector3::Zero();  ///< m
  double radius = 0;                             ///< m
};

/// Volume moments of the union of balls: what two balls share counts once.
///
/// Every slice across z is a union of discs. Its area and moments are integrals along the free arcs (Green's
/// theorem):
///     A = 1/2 sum (x dy - y dx)   Sx = 1/2 sum x^2 dy   Sy = -1/2 sum y^2 dx
///     Sxx = 1/3 sum x^3 dy   Syy = -1/3 sum y^3 dx   Sxy = 1/2 sum x^2 y dy
/// Slices are summed by Gauss' rule between the heights where balls or their intersections begin and end.
/// Relative error below 1e-7 (test "Two overlapping balls have the mass and inertia of the closed form").
VolumeMoments union_moments(std::span<const Ball> balls);

}  // namespace talus::dem
