#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "dem_solver/rocks/ball_union.hpp"
#include "dem_solver/rocks/polyhedron.hpp"
#include "dem_solver/rocks/sphere_filling.hpp"
#include "dem_solver/scene/rock_scene.hpp"
#include "dem_solver/solver.hpp"

/// What more spheres buy, one JSON object a line: a block of edge 1 m filled to smaller and smaller deviations, against its
/// surface (its mass and inertia are the surface's in any case; the spheres are what it touches with); and a block of 0.4 m
/// that lands flat on a plane at 2 m/s with a restitution of 0.5, filled, under Hertz's law with dashpots, and with spheres
/// along its surface on a foundation.
namespace {

using namespace talus::dem;

void print_shapes() {
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

struct Drop {
  const char* law;
  BlockScene block;
  PairParameters contact;
  LawChoice::Normal normal = LawChoice::Normal::hertz;
};

void print_drop(const Drop& drop, double resolution) {
  constexpr double speed = 2, edge = 0.4;
  RockScene scene;
  scene.shape = drop.block;
  scene.at = {0, 0, 0.5 * edge + 0.002};
  scene.velocity = {0, 0, -speed};
  const BuiltRock rock = build_rock("block", scene, 2600);
  ParticleModel model;
  model.law.normal = drop.normal;
  model.pairs = PairTable(2);
  model.pairs.set(0, 1, drop.contact);
  model.planes = {{.name = "floor", .point = {}, .normal = {0, 0, 1}, .material = 1}};
  model.step = 2e-6;
  model.rocks = {rock.rock};
  for (SphereInput sphere : rock.spheres) {
    sphere.rock = 0;
    model.spheres.push_back(sphere);
  }
  ParticleSolver solver(model);
  double largest = 0;
  const auto begin = std::chrono::steady_clock::now();
  constexpr int most_steps = 200'000;
  for (int n = 0;
       n < most_steps && !(largest > 0 && solver.rocks().force(0).z == 0 && solver.rocks().velocity(0).z > 0);
       ++n) {
    solver.step();
    largest = std::max(largest, solver.rocks().force(0).z);
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  fmt::print(
      "{{\"law\":\"{}\",\"resolution_m\":{},\"spheres\":{},\"largest_force_kN\":{:.1f},\"rebound\":{:.4f},"
      "\"seconds\":{:.3f}}}\n",
      drop.law, resolution, model.spheres.size(), 1e-3 * largest, solver.rocks().velocity(0).z / speed,
      seconds.count());
}

}  // namespace

int main() {
  print_shapes();
  const Material stone{.name = "stone", .density = 2600, .youngs_modulus = 1e7, .poissons_ratio = 0.2},
      rigid{.name = "rigid", .density = 0, .youngs_modulus = 1e20, .poissons_ratio = 0.25};
  for (const double deviation : {0.1, 0.05, 0.02, 0.01})
    print_drop({"hertz, dashpots, filled",
                {.edge = 0.4, .mass = {}, .cut = {}, .deviation = deviation, .spacing = {}},
                pair_parameters(HertzContact{0.5}, effective_moduli(stone, rigid))},
               deviation);
  for (const double spacing : {0.1, 0.05, 0.025, 0.0125})
    print_drop({"foundation, along the surface",
                {.edge = 0.4, .mass = {}, .cut = {}, .deviation = {}, .spacing = spacing},
                pair_parameters(FoundationContact{1e7, 1, 0.5}),
                LawChoice::Normal::foundation},
               spacing);
}
