#include <catch2/catch.hpp>

#include "core/errors.hpp"
#include "tests/verification/particles/laws_and_bodies.hpp"

using namespace talus;
using namespace talus::dem;
using namespace talus::dem::cases;

TEST_CASE("A plate on n x n balls rebounds as one ball does, under every law") {
  const Normal kind = GENERATE(Normal::hertz, Normal::linear, Normal::hysteretic_hertz, Normal::foundation);
  const double restitution = GENERATE(0.5, 0.2);
  const int n = GENERATE(1, 2, 3, 4, 10);
  const Law law{kind, restitution};
  ParticleModel model = empty_model(law);
  model.planes = {floor()};
  model.step = short_step(law, n * n, 100);
  add_body(model, plate(n, 1));
  ParticleSolver solver(model);
  until_free(solver);
  INFO(name_of(kind) << ", " << n * n << " balls");
  CHECK(solver.rocks().velocity(0).z == Approx(restitution).epsilon(0.01));
  CHECK(length(solver.rocks().spin(0)) < 1e-9);
  CHECK(solver.ledger().balance() == Approx(0.5 * 100).epsilon(2e-3));
}

TEST_CASE("A rod that falls on its end goes on as the mass it feels there is stopped and thrown back") {
  const Normal kind = GENERATE(Normal::hertz, Normal::linear, Normal::hysteretic_hertz, Normal::foundation);
  const double restitution = GENERATE(1.0, 0.5, 0.2), L = 1, mass = 100;
  const Law law{kind, restitution};
  ParticleModel model = empty_model(law);
  model.planes = {floor()};
  model.step = short_step(law, 4, mass);
  add_body(model, {.mass = mass,
                   .moments = {mass * L * L / 12, mass * L * L / 12, mass * L * L / 1200},
                   .centre = {0, 0, 0.051},
                   .velocity = {0, 0, -1},
                   .balls = {{0, 0.5 * L, 0}}});
  ParticleSolver solver(model);
  until_free(solver);
  // 1/m_eff = 1/m + (L/2)^2/(m L^2/12) = 4/m: the impulse (1 + e) v m/4 acts on the centre's motion.
  INFO(name_of(kind) << ", e " << restitution);
  const double end = solver.rocks().velocity(0).z + 0.5 * L * solver.rocks().spin(0).x;
  CHECK(solver.rocks().velocity(0).z == Approx(-1 + (1 + restitution) / 4).epsilon(0.01));
  CHECK(end == Approx(restitution).epsilon(0.01));
}

TEST_CASE("Two bodies of several balls collide and keep momentum, angular momentum and the ledger") {
  const Normal kind = GENERATE(Normal::hertz, Normal::linear, Normal::hysteretic_hertz, Normal::foundation);
  const Law law{kind, 0.4};
  ParticleModel model = empty_model(law);
  model.step = 0.25 * short_step(law, 4, 50);
  const std::vector<Triple<double>> corners{{0.1, 0.1, 0}, {-0.1, 0.1, 0}, {0.1, -0.1, 0}, {-0.1, -0.1, 0}};
  add_body(model, {.mass = 50,
                   .moments = {1, 2, 3},
                   .centre = {0, 0, 0},
                   .velocity = {0, 0, 1},
                   .spin = {0.3, 0, 1},
                   .balls = corners});
  add_body(model, {.mass = 100,
                   .moments = {3, 2, 4},
                   .centre = {0.03, 0.07, 0.2},
                   .velocity = {0, 0.2, -3},
                   .balls = corners});
  const auto momenta = [](const ParticleSolver& solver) {
    Triple<double> p, l;
    for (Index k = 0; k < 2; ++k) {
      const Triple<double> own = solver.rocks().mass(k) * solver.rocks().velocity(k);
      p = p + own;
      l = l + cross(solver.rocks().centre(k), own) + solver.rocks().angular_momentum(k);
    }
    return std::pair{p, l};
  };
  ParticleSolver solver(model);
  const auto [p0, l0] = momenta(solver);
  const double energy = solver.ledger().balance();
  until_free(solver);
  const auto [p1, l1] = momenta(solver);
  INFO(name_of(kind));
  CHECK(length(p1 - p0) < 1e-10 * length(p0));
  CHECK(length(l1 - l0) < 1e-10 * length(l0));
  CHECK(solver.ledger().balance() == Approx(energy).epsilon(2e-3));
  CHECK(solver.ledger().damping > 0.09 * energy);
}

TEST_CASE("A rock on many springs ends with an error above the limit of all of them together") {
  const Law law{Normal::linear, 1};
  const double limit = 2 * std::sqrt(100 / (16 * spring));  // of the plate's translation
  const auto run = [&](double part, bool allowed) {
    ParticleModel model = empty_model(law);
    model.planes = {floor()};
    model.may_be_unstable = allowed;
    Body body = plate(4, 1);
    body.moments = {1000, 1000, 1000};  // slower in every turn
    add_body(model, body);
    model.step = part * limit;
    ParticleSolver solver(model);
    for (int n = 0; n < 200; ++n) solver.step();
    return solver.rocks().velocity(0).z;
  };
  // At 0.9 of the limit the leapfrog is bounded: by its own invariant a spring leaves at most 1/sqrt(1 - 0.9^2) = 2.3 times as
  // fast as it was met, after several steps in contact less.
  CHECK(std::abs(run(0.9, false)) < 1.6);
  CHECK_THROWS_WITH(run(1.1, false), Catch::Contains("body0") && Catch::Contains("too stiff"));
  CHECK_NOTHROW(run(1.1, true));
}
