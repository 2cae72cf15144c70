#include <fmt/format.h>

#include "dem_solver/rocks/ball_union.hpp"
#include "dem_solver/rocks/polyhedron.hpp"
#include "dem_solver/rocks/sphere_filling.hpp"

/// What more spheres buy: a block of edge 1 m filled to smaller and smaller deviations, against its surface.
/// One JSON object a line. The rock's mass and inertia are the surface's in any case; the spheres are what it
/// touches with.
int main() {
  using namespace talus::dem;
  const talus::mesh::Surface block = make_block({.edge = 1, .cut = 0.25});
  const MassProperties solid = mass_properties(polyhedron_moments(block), 1);
  for (const double deviation : {0.2, 0.15, 0.1, 0.07}) {
    const SphereFilling filling = fill_with_spheres(block, {.deviation = deviation});
    const MassProperties filled = mass_properties(union_moments(filling.balls), 1);
    fmt::print(
        "{{\"deviation_m\":{},\"spheres\":{},\"deviation_at_nodes_m\":{:.4f},\"volume_error\":{:.4f},"
        "\"inertia_error\":{:.4f}}}\n",
        deviation, filling.balls.size(), filling.deviation, filled.mass / solid.mass - 1,
        filled.inertia.trace() / solid.inertia.trace() - 1);
  }
}
