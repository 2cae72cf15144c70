#pragma once

#include <span>
#include <vector>

#include "dem_solver/rocks/ball_union.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::dem {

/// Spheres that stand for a solid's surface in contacts, each for the share of it that is nearest to where it touches it.
struct SurfaceCover {
  std::vector<Ball> balls;            ///< inside the surface
  std::vector<double> areas;          ///< m^2; a ball's share; they add up to the surface
  std::vector<core::Vector3> facing;  ///< unit vectors out of the surface where it touches
  double deviation = 0;               ///< m; the largest distance of a node of the surface from the balls
};

struct CoverGoal {
  double spacing = 0;               ///< m; from ball to ball
  std::size_t most_balls = 20'000;  ///< an error beyond
};

/// Covers a closed surface from inside: wherever no ball is within the spacing on a face that looks the same way, another
/// that touches the surface there, with the spacing as radius or, where that reaches through another face, three quarters of what
/// fits. A ball stands for one
/// face only, so that a rock flat on a face presses with that face's area, whatever the spacing. Between the balls of a flat face lie
/// dents of a sixteenth of the spacing. Costs O(n log t) for n balls and t triangles.
/// @throws ConfigError where the goal needs more than most_balls. @pre closed_surface_fault(surface).empty()
SurfaceCover cover_with_spheres(const mesh::Surface& surface, const CoverGoal& goal);

/// m^2; a quarter of each ball's skin that lies in no other ball: for one ball alone the disc that it shows to a partner. Found
/// on 2000 points a ball.
std::vector<double> shown_areas(std::span<const Ball> balls);

}  // namespace talus::dem
