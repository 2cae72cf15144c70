#pragma once

#include <span>
#include <vector>

#include "dem_solver/rocks/ball_union.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::dem {

/// Spheres that stand for a solid in contacts.
struct SphereFilling {
  std::vector<Ball> balls;  ///< inside the surface, largest first
  double deviation = 0;     ///< m; the largest distance of a node of the surface from the spheres
};

/// m; from the balls to the surface's node that is furthest from them.
double largest_gap(std::span<const Ball> balls, const mesh::Surface& surface);

struct FillingGoal {
  double deviation = 0;             ///< m; wanted
  std::size_t most_balls = 20'000;  ///< an error beyond
};

/// Fills a closed surface with inscribed spheres: again and again the largest that fits around a point which
/// no sphere comes nearer to than the deviation. Points are those of a grid of half the deviation that lie
/// deeper than it. Sharp corners stay further from the spheres than the goal (a ball in a cube's corner
/// leaves 0.73 of its radius); what was reached is measured at the nodes and returned. The grid is never made
/// coarser than that. Lengths that differ by less than a billionth of the deviation count as equal, so that
/// the same solid gets the same spheres in every unit of length. Costs O(t log t) for t triangles and O(log
/// t) a grid point inside.
/// @throws ConfigError where the goal needs more than most_balls, more grid points than memory should hold,
/// or no sphere is as large as the deviation. @pre closed_surface_fault(surface).empty()
SphereFilling fill_with_spheres(const mesh::Surface& surface, const FillingGoal& goal);

}  // namespace talus::dem
