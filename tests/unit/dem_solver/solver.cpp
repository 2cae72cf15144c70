#include <catch2/catch.hpp>

#include <random>

#include "tests/verification/particles/particle_models.hpp"

using namespace talus;
using namespace talus::dem;
using namespace talus::dem::cases;

namespace {

/// A box of spheres of sizes 1 : 4 with friction and a ledger, thrown together.
ParticleModel shaken_box(int threads) {
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
        s.radius = 0.02 / (1 + 3 * u(random));
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
  ParticleSolver one(shaken_box(1)), two(shaken_box(2)), four(shaken_box(4));
  const auto expected = state_after(one, 3000);
  REQUIRE(one.searches() > 2);
  CHECK(state_after(two, 3000) == expected);
  CHECK(state_after(four, 3000) == expected);
}

TEST_CASE("A copy of the solver continues with the same bits") {
  ParticleSolver solver(shaken_box(1));
  state_after(solver, 1000);
  ParticleSolver saved = solver;
  CHECK(state_after(saved, 1000) == state_after(solver, 1000));
}

TEST_CASE("The neighbour list finds every touching pair of sizes 1 to 50") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<SphereInput> input;
  for (int i = 0; i < 1500; ++i)
    input.push_back({.position = {u(random), u(random), 3 * u(random)},
                     .velocity = {},
                     .spin = {},
                     .radius = 0.002 * std::pow(50, u(random) * u(random)),
                     .mass = 1});
  Spheres spheres;
  spheres.add(input, false);
  PairList list;
  const double skin = 0.001;
  list.rebuild(spheres, skin, 1);
  std::size_t expected = 0;
  for (std::size_t i = 0; i < input.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (length(input[i].position - input[j].position) < input[i].radius + input[j].radius + skin)
        ++expected;
  CHECK(list.other().size() + list.wide().size() == expected);
  CHECK_FALSE(list.wide().empty());
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
