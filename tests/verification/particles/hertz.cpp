#include <catch2/catch.hpp>

#include "tests/verification/particles/particle_models.hpp"

using namespace talus::dem;
using namespace talus::dem::cases;

namespace {

struct CollisionResult {
  double largest_overlap = 0, largest_force = 0, duration = 0;
};

/// Runs until the spheres are apart again; the start is at first touch.
CollisionResult collide(ParticleSolver& solver, const std::function<double()>& overlap) {
  CollisionResult result;
  std::int64_t steps_in_contact = 0;
  for (bool touched = false; solver.steps_done() < 1'000'000;) {
    const double now = overlap();
    solver.step();
    const double f = length(force(solver, 0));
    result.largest_overlap = std::max(result.largest_overlap, now);
    result.largest_force = std::max(result.largest_force, f);
    if (now > 0) ++steps_in_contact;
    if (touched && now <= 0) break;
    touched = touched || now > 0;
  }
  result.duration = static_cast<double>(steps_in_contact) * solver.step_length();
  return result;
}

/// The step is a five thousandth of the collision: peaks are met within (pi/2/5000)^2, the duration within
/// two steps.
constexpr double steps_in_collision = 5000;
constexpr double peak_tolerance = 1e-5;
constexpr double duration_tolerance = 3 / steps_in_collision;

void check_head_on(SphereCase c, double relative_speed, double published_overlap, double published_force,
                   double published_duration) {
  const double modulus = effective_moduli(c.material(), c.material()).normal;
  const HertzCollision exact{c.radius / 2, c.mass() / 2, modulus, relative_speed};
  CHECK(exact.largest_overlap() == Approx(published_overlap).epsilon(5e-5));
  CHECK(exact.largest_force() == Approx(published_force).epsilon(5e-5));
  CHECK(exact.duration() == Approx(published_duration).epsilon(5e-4));
  c.step = exact.duration() / steps_in_collision;

  ParticleModel model = model_of(c, rigid());
  const double start = c.radius * (1 + 1e-12);
  model.spheres = {c.sphere({-start, 0, 0}, {relative_speed / 2, 0, 0}),
                   c.sphere({start, 0, 0}, {-relative_speed / 2, 0, 0})};
  ParticleSolver solver(model);
  const CollisionResult result =
      collide(solver, [&] { return 2 * c.radius - length(position(solver, 0) - position(solver, 1)); });
  CHECK(result.largest_overlap == Approx(exact.largest_overlap()).epsilon(peak_tolerance));
  CHECK(result.largest_force == Approx(exact.largest_force()).epsilon(peak_tolerance));
  CHECK(result.duration == Approx(exact.duration()).epsilon(duration_tolerance));
  CHECK(velocity(solver, 0).x == Approx(-relative_speed / 2).epsilon(1e-5));
}

}  // namespace

TEST_CASE("Two equal glass spheres head on have Hertz's overlap, force and duration") {
  check_head_on({.radius = 0.01, .density = 2800, .youngs_modulus = 4.8e10, .poissons_ratio = 0.2}, 20,
                274.11e-6, 10696.9, 40.34e-6);
}

TEST_CASE("Two equal limestone spheres head on have Hertz's overlap, force and duration") {
  check_head_on({.radius = 0.01, .density = 2500, .youngs_modulus = 2e10, .poissons_ratio = 0.25}, 20,
                368.30e-6, 7108.2, 54.20e-6);
}

TEST_CASE("An aluminium sphere on a rigid plane has Hertz's overlap, force and duration") {
  SphereCase c{.radius = 0.1, .density = 2699, .youngs_modulus = 7e10, .poissons_ratio = 0.3};
  const double speed = 0.2;
  const HertzCollision exact{c.radius, c.mass(), effective_moduli(c.material(), rigid()).normal, speed};
  CHECK(exact.largest_overlap() == Approx(49.717e-6).epsilon(5e-5));
  CHECK(exact.largest_force() == Approx(11369.9).epsilon(5e-5));
  CHECK(exact.duration() == Approx(731.7e-6).epsilon(5e-4));
  c.step = exact.duration() / steps_in_collision;

  ParticleModel model = model_of(c, rigid());
  model.planes = {floor()};
  model.spheres = {c.sphere({0, 0, c.radius * (1 + 1e-12)}, {0, 0, -speed})};
  ParticleSolver solver(model);
  const CollisionResult result = collide(solver, [&] { return c.radius - position(solver, 0).z; });
  CHECK(result.largest_overlap == Approx(exact.largest_overlap()).epsilon(peak_tolerance));
  CHECK(result.largest_force == Approx(exact.largest_force()).epsilon(peak_tolerance));
  CHECK(result.duration == Approx(exact.duration()).epsilon(duration_tolerance));
  CHECK(velocity(solver, 0).z == Approx(speed).epsilon(1e-5));
}

TEST_CASE("Restitution of a Hertz contact is the one asked for at any speed, size and stiffness") {
  struct Impact {
    double radius, speed, youngs_modulus;
  };
  const Impact impact = GENERATE(Impact{0.0025, 3.9, 3.8e11}, Impact{0.0025, 0.1, 3.8e11},
                                 Impact{0.0025, 30, 3.8e11}, Impact{1, 3.9, 3.8e11}, Impact{1, 30, 1e7});
  const double restitution = GENERATE(0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 1.0);
  SphereCase c{.radius = impact.radius,
               .density = 4000,
               .youngs_modulus = impact.youngs_modulus,
               .poissons_ratio = 0.23};
  c.restitution = restitution;
  const HertzCollision undamped{c.radius, c.mass(), effective_moduli(c.material(), rigid()).normal,
                                impact.speed};
  c.step = undamped.duration() / steps_in_collision;

  ParticleModel model = model_of(c, rigid());
  model.planes = {floor()};
  model.spheres = {c.sphere({0, 0, c.radius * (1 + 1e-12)}, {0, 0, -impact.speed})};
  ParticleSolver solver(model);
  collide(solver, [&] { return c.radius - position(solver, 0).z; });
  // The first-order error of the half-step-old velocity in the dashpot is below a thousandth at this step.
  CHECK(velocity(solver, 0).z / impact.speed == Approx(restitution).epsilon(1e-3));
}
