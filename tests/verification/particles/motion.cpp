#include <catch2/catch.hpp>

#include "tests/verification/particles/particle_models.hpp"

using namespace talus::dem;
using namespace talus::dem::cases;

TEST_CASE("Free fall is the parabola to round-off") {
  SphereCase c{.step = 1e-3};
  ParticleModel model = model_of(c, rigid());
  model.gravity = {0, 0, -g};
  model.spheres = {c.sphere({0, 0, 5}, {2, 0, 1})};
  ParticleSolver solver(model);
  for (int n = 1; n <= 1000; ++n) {
    solver.step();
    const double exact = 5 + n * 1 * c.step - g * c.step * c.step * n * n / 2.0;
    REQUIRE(position(solver, 0).z == Approx(exact).margin(1e-12));
    REQUIRE(position(solver, 0).x == Approx(2 * n * c.step).margin(1e-12));
  }
}

TEST_CASE("Free fall is exact in steps of changing length") {
  // A constant acceleration has no error.
  SphereCase c{.step = 1e-3};
  ParticleModel model = model_of(c, rigid());
  model.gravity = {0, 0, -g};
  model.spheres = {c.sphere({0, 0, 5}, {0, 0, 1})};
  ParticleSolver solver(model);
  double before = 0;
  for (const double step : {1e-3, 4e-3, 0.5e-3, 0.5e-3, 7e-3, 1e-3}) {
    solver.set_clock({.time = solver.time(), .step = step});
    solver.step();
    const double time = solver.time(), v0 = 1;
    CHECK(position(solver, 0).z == Approx(5 + v0 * time - g * time * time / 2).margin(1e-12));
    // The energy of a leapfrog at the time of its forces: 1/2 m (v^2 - h_1 h_2 g^2/4).
    const double at_forces = time - step, v = v0 - g * at_forces;
    CHECK(solver.ledger().kinetic ==
          Approx(0.5 * c.mass() * (v * v - before * step * g * g / 4)).epsilon(1e-12));
    before = step;
  }
}

TEST_CASE("A sphere at rest on a plane has the overlap that carries its weight") {
  SphereCase c{.restitution = 0.1, .step = 1e-4};
  ParticleModel model = model_of(c, rigid());
  model.gravity = {0, 0, -g};
  model.planes = {floor()};
  model.spheres = {c.sphere({0, 0, c.radius}, {})};
  ParticleSolver solver(model);
  for (int n = 0; n < 20000; ++n) solver.step();
  const double modulus = effective_moduli(c.material(), rigid()).normal;
  const double overlap = std::pow(3 * c.mass() * g / (4 * modulus * std::sqrt(c.radius)), 2.0 / 3);
  CHECK(c.radius - position(solver, 0).z == Approx(overlap).epsilon(1e-9));
}

namespace {

/// Starts a sphere at rest in its overlap on the floor, so that nothing bounces.
ParticleModel settled_on_floor(const SphereCase& c, Triple<double> gravity, Triple<double> velocity) {
  ParticleModel model = model_of(c, rigid());
  model.gravity = gravity;
  model.planes = {floor()};
  const double modulus = effective_moduli(c.material(), rigid()).normal;
  const double overlap = std::pow(-3 * c.mass() * gravity.z / (4 * modulus * std::sqrt(c.radius)), 2.0 / 3);
  model.spheres = {c.sphere({0, 0, c.radius - overlap}, velocity)};
  return model;
}

/// A stiff, damped sphere: its rolling radius is smaller than R by the overlap, which is to be below the
/// tolerance.
constexpr SphereCase stiff{
    .radius = 0.1, .youngs_modulus = 1e9, .restitution = 0.3, .friction = 0.3, .step = 5e-6};

}  // namespace

TEST_CASE("A sphere rolls down a flat incline with 5/7 of the slope's pull and slides down a steep one") {
  const double mu = stiff.friction;
  const double angle =
      GENERATE_COPY(0.5 * std::atan(3.5 * mu), 0.95 * std::atan(3.5 * mu), 1.05 * std::atan(3.5 * mu), 1.2);
  const bool rolls = std::tan(angle) < 3.5 * mu;
  const double exact = rolls ? 5.0 / 7 * g * std::sin(angle) : g * (std::sin(angle) - mu * std::cos(angle));
  ParticleSolver solver(settled_on_floor(stiff, {g * std::sin(angle), 0, -g * std::cos(angle)}, {}));
  // The acceleration between two times leaves out the first wind-up of the tangential spring.
  const int early = 20'000, late = 60'000;
  double early_speed = 0;
  for (int n = 1; n <= late; ++n) {
    solver.step();
    if (n == early) early_speed = velocity(solver, 0).x;
  }
  const double acceleration = (velocity(solver, 0).x - early_speed) / ((late - early) * stiff.step);
  CHECK(acceleration == Approx(exact).epsilon(1e-3));
}

TEST_CASE("A sliding sphere begins to roll after 2 v/(7 mu g) with 5/7 of its speed") {
  const double v0 = 1, mu = stiff.friction;
  ParticleSolver solver(settled_on_floor(stiff, {0, 0, -g}, {v0, 0, 0}));
  const double exact_time = 2 * v0 / (7 * mu * g);
  double rolling_since = -1;
  while (solver.time() < 1.5 * exact_time) {
    solver.step();
    const double slip = velocity(solver, 0).x - stiff.radius * spin(solver, 0).y;
    if (rolling_since < 0 && slip < 1e-3 * v0) rolling_since = solver.time();
  }
  CHECK(rolling_since == Approx(exact_time).epsilon(3e-3));
  CHECK(velocity(solver, 0).x == Approx(5.0 / 7 * v0).epsilon(1e-3));
}

TEST_CASE("A sphere in gross sliding keeps Coulomb's change of speed and spin") {
  SphereCase c{.radius = 0.0025,
               .density = 4000,
               .youngs_modulus = 3.8e11,
               .poissons_ratio = 0.23,
               .restitution = 0.98,
               .friction = 0.092};
  const double speed = 3.9;
  const double angle = GENERATE_COPY(1.05 * std::atan(3.5 * 0.092 * 1.98), 1.0, 1.3);
  const double vn = speed * std::cos(angle), vt = speed * std::sin(angle);
  REQUIRE(std::tan(angle) > 3.5 * c.friction * (1 + c.restitution));
  c.step = HertzCollision{c.radius, c.mass(), effective_moduli(c.material(), rigid()).normal, vn}.duration() /
           2000;
  ParticleModel model = model_of(c, rigid());
  model.planes = {floor()};
  model.spheres = {c.sphere({0, 0, c.radius}, {vt, 0, -vn})};
  ParticleSolver solver(model);
  for (int n = 0; n < 4000; ++n) solver.step();
  CHECK(velocity(solver, 0).x == Approx(vt - c.friction * (1 + c.restitution) * vn).epsilon(0.01));
  CHECK(spin(solver, 0).y * c.radius == Approx(2.5 * c.friction * (1 + c.restitution) * vn).epsilon(0.01));
}

TEST_CASE("Equal spheres with opposite spins keep them and gain no tangential speed") {
  SphereCase c{.radius = 0.1,
               .density = 2700,
               .youngs_modulus = 7e10,
               .poissons_ratio = 0.33,
               .restitution = 0.5,
               .friction = 0.4};
  const double w = GENERATE(0.175, 2.0, 22.86), vn = 0.2;
  c.step =
      HertzCollision{c.radius / 2, c.mass() / 2, effective_moduli(c.material(), c.material()).normal, 2 * vn}
          .duration() /
      500;
  ParticleModel model = model_of(c, rigid());
  model.spheres = {c.sphere({-c.radius, 0, 0}, {vn, 0, 0}, {0, w, 0}),
                   c.sphere({c.radius, 0, 0}, {-vn, 0, 0}, {0, -w, 0})};
  ParticleSolver solver(model);
  for (int n = 0; n < 2000; ++n) solver.step();
  REQUIRE(velocity(solver, 0).x < 0);
  for (Index id : {0, 1}) {
    CHECK(velocity(solver, id).z == Approx(0).margin(1e-12));
    CHECK(std::abs(spin(solver, id).y) == Approx(w).epsilon(1e-12));
  }
}
