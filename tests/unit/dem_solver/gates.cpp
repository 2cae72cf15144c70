#include <catch2/catch.hpp>

#include "dem_solver/output/particle_output.hpp"
#include "tests/verification/particles/particle_models.hpp"

using namespace talus::dem;
using namespace talus::dem::cases;

namespace {

/// Stones that fly freely along z: radius, place along x, height and speed.
struct Flight {
  double radius, x, z, speed;
};
ParticleSolver fly(const std::vector<Flight>& flights, const std::vector<Gate>& gates, double time) {
  ParticleModel model = model_of({.step = 1e-3}, rigid());
  for (const Flight& f : flights) {
    const SphereCase c{.radius = f.radius, .step = 1e-3};
    model.spheres.push_back(c.sphere({f.x, 0, f.z}, {0, 0, f.speed}));
  }
  model.gates = gates;
  ParticleSolver solver(model);
  while (solver.time() < time) solver.step();
  return solver;
}

const Gate down{.name = "floor", .point = {}, .normal = {0, 0, -1}, .radius = 1};

}  // namespace

TEST_CASE("A gate counts the stones that pass it along its normal, with their sizes, mass and energy") {
  const auto solver = fly({{0.1, 0, 0.5, -3},        // passes
                           {0.05, 0.5, 0.2, -2},     // passes
                           {0.1, -0.5, -0.5, 3},     // the other way
                           {0.2, 3, 0.5, -3},        // outside the disc
                           {0.1, -0.9, 0.9, -0.5},   // not yet
                           {0.15, -1.5, -0.5, -1}},  // behind from the start
                          {down}, 0.5);
  const Passed& passed = solver.gates().passed()[0];
  const double mass[] = {ball_mass(0.1, 2500), ball_mass(0.05, 2500)};
  CHECK(passed.stones == 2);
  CHECK(passed.mass == Approx(mass[0] + mass[1]).epsilon(1e-14));
  CHECK(passed.kinetic_energy == Approx(0.5 * mass[0] * 9 + 0.5 * mass[1] * 4).epsilon(1e-14));
  CHECK(passed.smallest_radius == 0.05);
  CHECK(passed.largest_radius == 0.1);
}

TEST_CASE("A stone that swings through a gate again and again counts once") {
  ParticleModel model = model_of({.restitution = 1, .step = 1e-4}, rigid());
  model.planes = {{"below", {0, 0, -0.3}, {0, 0, 1}, 1}, {"above", {0, 0, 0.3}, {0, 0, -1}, 1}};
  const SphereCase c{.step = 1e-4};
  model.spheres = {c.sphere({0, 0, 0.1}, {0, 0, -5})};
  model.gates = {down};
  ParticleSolver solver(model);
  int turns = 0;
  for (double last = -5; solver.time() < 1; last = velocity(solver, 0).z) {
    solver.step();
    turns += (velocity(solver, 0).z > 0) != (last > 0);
  }
  REQUIRE(turns > 5);
  CHECK(solver.gates().passed()[0].stones == 1);
}

TEST_CASE("A rock counts as one stone, as large as the sphere that holds it") {
  ParticleModel model = model_of({.step = 1e-3}, rigid());
  const SphereCase c{.radius = 0.1, .step = 1e-3};
  for (const double x : {-0.08, 0.08}) {
    SphereInput part = c.sphere({x, 0, 0.2}, {0, 0, -2});
    part.rock = 0;
    part.mass = 7;
    model.spheres.push_back(part);
  }
  model.rocks = {
      {.mass = 7, .moments = {1, 1, 1}, .centre = {0, 0, 0.2}, .velocity = {0, 0, -2}, .spin = {}}};
  model.gates = {down};
  ParticleSolver solver(model);
  while (solver.time() < 0.3) solver.step();
  const Passed& passed = solver.gates().passed()[0];
  CHECK(passed.stones == 1);
  CHECK(passed.mass == 7);
  CHECK(passed.largest_radius == Approx(0.18).epsilon(1e-14));
}

TEST_CASE("Gates have columns of their own in the output") {
  const auto solver = fly({{0.1, 0, 0.5, -3}}, {down}, 0.5);
  const ParticleOutput output(solver, {}, {});
  std::vector<double> values(output.description().probes.size());
  output.fill_probes(values);
  REQUIRE(values.size() == 5);
  CHECK(output.description().probes[0].name == "floor.stones_passed");
  CHECK(values[0] == 1);
  CHECK(output.description().probes[4].name == "floor.largest_radius_m");
  CHECK(values[4] == 0.1);
}
