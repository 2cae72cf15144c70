#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <random>
#include <utility>

#include "dem_solver/output/checkpoint.hpp"
#include "tests/support/folder.hpp"
#include "tests/verification/particles/particle_models.hpp"

using namespace talus;
using namespace talus::dem;
using namespace talus::dem::cases;

namespace {

/// A box of spheres of sizes 1 : 4, or all of one, with friction and a ledger, thrown together.
ParticleModel shaken_box(int threads, double largest_over_smallest = 4) {
  const SphereCase c{
      .radius = 0.01, .youngs_modulus = 1e7, .restitution = 0.4, .friction = 0.5, .step = 2e-5};
  ParticleModel model = model_of(c, rigid());
  model.law.ledger = true;
  model.threads = threads;
  model.gravity = {0, 0, -9.81};
  model.planes = {floor(),
                  {"west", {0, 0, 0}, {1, 0, 0}, 1},
                  {"east", {0.6, 0, 0}, {-1, 0, 0}, 1},
                  {"south", {0, 0, 0}, {0, 1, 0}, 1},
                  {"north", {0, 0.3, 0}, {0, -1, 0}, 1}};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(0, 1);
  for (int i = 0; i < 14; ++i)
    for (int j = 0; j < 7; ++j)
      for (int k = 0; k < 4; ++k) {
        SphereCase s = c;
        s.radius = 0.02 / (1 + (largest_over_smallest - 1) * u(random));
        model.spheres.push_back(s.sphere({0.021 + 0.041 * i, 0.021 + 0.041 * j, 0.021 + 0.041 * k},
                                         {2 * u(random) - 1, 2 * u(random) - 1, -1}));
      }
  return model;
}

std::vector<double> state_after(ParticleSolver& solver, int steps) {
  for (int n = 0; n < steps; ++n) solver.step();
  std::vector<double> state;
  for (Index id = 0; id < solver.spheres().size(); ++id)
    for (const auto& t : {position(solver, id), velocity(solver, id), spin(solver, id)})
      state.insert(state.end(), {t.x, t.y, t.z});
  const ParticleLedger l = solver.ledger();
  state.insert(state.end(), {l.kinetic, l.elastic, l.damping, l.friction});
  return state;
}

}  // namespace

TEST_CASE("One, two and four threads give the same bits") {
  const double sizes = GENERATE(1.0, 4.0);
  ParticleSolver one(shaken_box(1, sizes)), two(shaken_box(2, sizes)), four(shaken_box(4, sizes));
  const auto expected = state_after(one, 3000);
  REQUIRE(one.searches() > 2);
  CHECK(one.pair_list().wide().empty() == (sizes == 1));
  CHECK(state_after(two, 3000) == expected);
  CHECK(state_after(four, 3000) == expected);
}

TEST_CASE("Stages whose time is told apart give the bits of those that go through a block at once") {
  ParticleSolver at_once(shaken_box(2, 1)), told_apart(shaken_box(2, 1));
  core::StageClock clock = make_stage_clock();
  told_apart.measure_stages(clock);
  CHECK(state_after(told_apart, 3000) == state_after(at_once, 3000));
}

TEST_CASE("A copy of the solver continues with the same bits") {
  ParticleSolver solver(shaken_box(1));
  state_after(solver, 1000);
  ParticleSolver saved = solver;
  CHECK(state_after(saved, 1000) == state_after(solver, 1000));
}

TEST_CASE("A solver restored from a checkpoint continues with the same bits") {
  const test::Folder folder("dem_checkpoint");
  ParticleSolver solver(shaken_box(1));
  state_after(solver, 1234);
  write_checkpoint(solver, folder / "state.h5");
  ParticleSolver restored(shaken_box(2));
  read_checkpoint(restored, folder / "state.h5");
  CHECK(restored.steps_done() == 1234);
  CHECK(state_after(restored, 1000) == state_after(solver, 1000));
}

namespace {

/// A rock of two spheres and some spheres fall into a trough of two moving triangles and a wire.
ParticleModel rock_in_a_trough() {
  const SphereCase c{
      .radius = 0.02, .youngs_modulus = 1e7, .restitution = 0.4, .friction = 0.5, .step = 2e-5};
  ParticleModel model = model_of(c, rigid());
  model.law.ledger = true;
  model.gravity = {0, 0, -9.81};
  mesh::Surface trough;
  trough.positions = {0, -1, 0, 0, 1, 0, 1, 0, 0.3, -1, 0, 0.3, -1, 0.01, 0.02, 1, 0.01, 0.02};
  trough.triangles = {{0, 1, 2}, {0, 1, 3}};
  trough.segments = {{4, 5}};
  trough.parts = {{.name = "slopes", .triangle_end = 2},
                  {.name = "wire", .wire_radius = 0.005, .segment_end = 1}};
  model.boundary = Boundary(trough, std::array<Index, 2>{1, 1});
  model.boundary.set_velocity(0, {0.1, 0, 0});
  for (int i = 0; i < 5; ++i)
    model.spheres.push_back(c.sphere({0.05 * i - 0.1, 0.05, 0.1}, {0, 0, -1}, {9, 0, 0}));
  for (const double x : {-0.015, 0.015}) {
    SphereInput part = c.sphere({x, 0, 0.2}, {0, 0, -2});
    part.mass = 2 * c.mass();
    part.rock = 0;
    model.spheres.push_back(part);
  }
  model.rocks = {{.mass = 2 * c.mass(),
                  .moments = {1e-5, 3e-5, 4e-5},
                  .centre = {0, 0, 0.2},
                  .velocity = {0, 0, -2},
                  .spin = {5, 20, 1}}};
  return model;
}

}  // namespace

TEST_CASE("Rocks and contacts with a moving boundary continue from a checkpoint with the same bits") {
  const test::Folder folder("dem_checkpoint_rock");
  ParticleSolver solver(rock_in_a_trough());
  state_after(solver, 3000);
  REQUIRE(std::ranges::any_of(solver.boundary_list().count(), [](Index n) { return n > 0; }));
  write_checkpoint(solver, folder / "state.h5");
  ParticleSolver restored(rock_in_a_trough());
  read_checkpoint(restored, folder / "state.h5");
  CHECK(state_after(restored, 3000) == state_after(solver, 3000));
  CHECK(restored.rocks().orientation(0).x == solver.rocks().orientation(0).x);
}

TEST_CASE("A checkpoint of another scene is refused") {
  const test::Folder folder("dem_checkpoint_other");
  ParticleSolver solver(shaken_box(1));
  write_checkpoint(solver, folder / "state.h5");
  ParticleModel without_ledger = shaken_box(1);
  without_ledger.law.ledger = false;
  ParticleSolver unlike(without_ledger);
  CHECK_THROWS_WITH(read_checkpoint(unlike, folder / "state.h5"), Catch::Contains("other terms"));
  ParticleModel fewer = shaken_box(1);
  fewer.spheres.pop_back();
  ParticleSolver other(fewer);
  CHECK_THROWS_WITH(read_checkpoint(other, folder / "state.h5"), Catch::Contains("belongs to another scene"));
  CHECK_THROWS_WITH(read_checkpoint(other, folder / "none.h5"),
                    Catch::Contains("cannot be read as a checkpoint"));
}

TEST_CASE("The neighbour list has every touching pair of sizes 1 to 200 once, and no other") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<SphereInput> input;
  for (int i = 0; i < 1500; ++i)
    input.push_back({.position = {u(random), u(random), 3 * u(random)},
                     .velocity = {},
                     .spin = {},
                     .radius = 0.002 * std::pow(200, u(random) * u(random)),
                     .mass = 1});
  Spheres spheres;
  spheres.add(input, {});
  PairList list;
  const double skin = 0.001;
  const auto [place, moves] = list.rebuild(spheres, {.skin = skin});
  using Pair = std::pair<Index, Index>;
  std::vector<Pair> expected, found;
  for (std::size_t i = 0; i < input.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (length(input[i].position - input[j].position) < input[i].radius + input[j].radius + skin)
        expected.push_back(std::minmax(place[i], place[j]));
  for (Index i = 0; i < static_cast<Index>(input.size()); ++i)
    for (Index slot = list.first()[i]; slot < list.first()[i + 1]; ++slot)
      found.push_back(std::minmax(i, list.other()[slot]));
  for (const auto& wide : list.wide()) found.push_back(std::minmax(wide.first, wide.second));
  std::ranges::sort(expected);
  std::ranges::sort(found);
  CHECK(found == expected);  // each pair, and each once
  CHECK_FALSE(list.wide().empty());
}

TEST_CASE("A grid has a cell for each place of a lattice, in whatever order its points come") {
  constexpr int side = 30;
  std::vector<Row> points;
  for (int i = 0; i < side * side * side; ++i)
    points.push_back(row({1.0 * (i % side), 1.0 * (i / side % side), 1.0 * (i / side / side)}));
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::ranges::shuffle(points, std::mt19937(seed));
    CHECK(CellGrid(points, 1).counts() == CellGrid::Cell{side, side, side});
  }
}

TEST_CASE("The ledger of a damped, sliding bed closes") {
  ParticleSolver solver(shaken_box(1));
  const double start = solver.ledger().balance();
  const double kinetic = solver.ledger().kinetic;
  state_after(solver, 3000);
  const ParticleLedger l = solver.ledger();
  REQUIRE(l.damping > 0.05 * kinetic);
  REQUIRE(l.friction > 0.05 * kinetic);
  // Contacts last some 60 steps; the leapfrog's own error is second order in their inverse.
  CHECK(std::abs(l.balance() - start) < 5e-3 * kinetic);
}
