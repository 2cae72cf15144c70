#include <catch2/catch.hpp>

#include <random>

#include "dem_solver/output/checkpoint.hpp"
#include "dem_solver/output/particle_output.hpp"
#include "dem_solver/output/sieve.hpp"
#include "tests/support/folder.hpp"
#include "tests/verification/particles/particle_models.hpp"

using namespace talus;
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
  REQUIRE(values.size() == 6);
  CHECK(output.description().probes[0].name == "floor.stones_passed");
  CHECK(values[0] == 1);
  CHECK(output.description().probes[4].name == "floor.largest_radius_m");
  CHECK(values[4] == 0.1);
  CHECK(output.description().probes[5].name == "floor.stones_held");
  CHECK(values[5] == 0);
}

TEST_CASE("A gate remembers when each stone was in its plane, which stone, how large and how fast") {
  const auto solver =
      fly({{0.1, 0, 0.5003, -3}, {0.05, 0.5, 0.2001, -2}, {0.1, -0.9, 0.9, -0.5}}, {down}, 0.5);
  const auto& passages = solver.gates().passages(0);
  REQUIRE(passages.size() == 2);
  const auto check = [](const Passage& p, const Flight& f, std::int64_t stone) {
    CHECK(p.time == Approx(f.z / -f.speed).epsilon(1e-12));
    CHECK(p.stone == stone);
    CHECK(p.diameter == 2 * f.radius);
    CHECK(p.speed == -f.speed);
  };
  check(passages[0], {0.05, 0.5, 0.2001, -2}, 1);
  check(passages[1], {0.1, 0, 0.5003, -3}, 0);
}

TEST_CASE("No stone passes unseen, however far from the gate it was when neighbours were searched last") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> height(-2, 2), speed(-6, 2);
  std::vector<Flight> flights;
  for (int k = 0; k < 300; ++k) flights.push_back({0.1, 0.3 * k, height(random), speed(random)});
  Gate everywhere = down;
  everywhere.radius = std::numeric_limits<double>::infinity();
  const double end = 0.5;
  const auto solver = fly(flights, {everywhere}, end);
  std::int64_t expected = 0;
  for (const Flight& f : flights) expected += f.z > 0 && f.z + end * f.speed < 0;
  REQUIRE(expected > 50);
  REQUIRE(solver.searches() < 400);  // most steps look at the stones near the gate only
  CHECK(solver.gates().passed()[0].stones == expected);
  CHECK(static_cast<std::int64_t>(solver.gates().passages(0).size()) == expected);
}

TEST_CASE("The sizes table counts every stone once, passed or held, between the sieves it lies between") {
  const auto solver = fly({{0.1, 0, 0.5, -3}, {0.06, 0.5, 0.2, -2}, {0.11, -0.9, 0.9, -0.5}}, {down}, 0.5);
  const GateTables tables(solver);
  std::vector<double> values(static_cast<std::size_t>(tables.rows(1)) * 6);
  tables.fill(1, 0, values);
  // diameters 0.12, 0.2 and 0.22 m: the sieves of 100 and 125 mm, and of 200 and 250 mm
  CHECK(values == std::vector<double>{0.1, 0.125, 1, 0, 0, 0, 0.2, 0.25, 1, 1, 0, 0});
}

TEST_CASE("A run that goes on from a checkpoint knows the stones that passed before it") {
  const test::Folder folder("dem_checkpoint_gates");
  const std::vector<Flight> flights{{0.1, 0, 0.5, -3}, {0.05, 0.5, 0.2, -2}};
  ParticleSolver whole = fly(flights, {down}, 0.12), rest = fly(flights, {down}, 0);
  REQUIRE(whole.gates().passages(0).size() == 1);
  write_checkpoint(whole, folder / "state.h5");
  read_checkpoint(rest, folder / "state.h5");
  for (ParticleSolver* solver : {&whole, &rest})
    while (solver->time() < 0.3) solver->step();
  REQUIRE(whole.gates().passages(0).size() == 2);
  CHECK(rest.gates().passages(0) == whole.gates().passages(0));
  CHECK_FALSE(rest.gates().holds_sphere(0, 1));
}

TEST_CASE("Sieves are the preferred numbers of ISO 3, R 10, in every decade") {
  const double preferred[] = {1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3, 8, 10};
  for (int k = 0; k <= 10; ++k) CHECK(sieve_opening(k) == preferred[k]);
  CHECK(sieve_opening(-10) == 0.1);
  CHECK(sieve_opening(-11) == 0.08);
  CHECK(sieve_opening(-12) == 0.063);
  for (int k = -40; k < 20; ++k) {
    CHECK(sieve_that_holds(sieve_opening(k)) == k);
    CHECK(sieve_that_holds(std::nextafter(sieve_opening(k), 0)) == k - 1);
  }
}
