#include <catch2/catch.hpp>

#include "tests/verification/particles/particle_models.hpp"

using namespace talus::dem;
using namespace talus::dem::cases;
using std::numbers::pi;

namespace {

/// A damped oscillator that is let go when its force would begin to pull, z < 1 (restitution.hpp; here in its
/// own words): the force k x + c v is zero when tan(s t) = -2 z s/(1 - 2 z^2), s = sqrt(1 - z^2), at
/// t = 2 arccos(z)/s, in units of sqrt(m/k).
struct Rebound {
  double damping_ratio = 0;
  double time() const { return 2 * std::acos(damping_ratio) / std::sqrt(1 - damping_ratio * damping_ratio); }
  double restitution() const { return std::exp(-damping_ratio * time()); }
};

/// Of spheres that fly at a rigid floor or at each other, on linear springs.
ParticleModel on_linear_springs(const SphereCase& c, const LinearContact& spring) {
  ParticleModel model = model_of(c, rigid());
  model.law.normal = LawChoice::Normal::linear;
  for (Index partner : {0, 1}) model.pairs.set(0, partner, pair_parameters(spring));
  return model;
}

}  // namespace

TEST_CASE("A collision on linear springs lasts as long as the oscillator and rebounds as asked for") {
  const Rebound exact{GENERATE(0.0, 0.05, 0.3, 0.7)};
  const bool on_floor = GENERATE(true, false);
  SphereCase c{.radius = 0.05, .density = 2600};
  const double stiffness = 1e6, mass = on_floor ? c.mass() : c.mass() / 2, speed = 3;
  const double unit = std::sqrt(mass / stiffness);
  const int steps_a_unit = 2000;
  c.step = unit / steps_a_unit;
  ParticleModel model = on_linear_springs(c, {.stiffness = stiffness, .restitution = exact.restitution()});
  if (on_floor) {
    model.planes = {floor()};
    model.spheres = {c.sphere({0, 0, c.radius}, {0, 0, -speed})};
  } else {
    model.spheres = {c.sphere({0, 0, c.radius}, {0, 0, -speed / 2}),
                     c.sphere({0, 0, -c.radius}, {0, 0, speed / 2})};
  }
  ParticleSolver solver(model);
  int pushing = 0;
  for (int n = 0; n < 4 * steps_a_unit; ++n) {
    solver.step();
    if (force(solver, 0).z > 0) ++pushing;
  }
  const double rebound = on_floor ? velocity(solver, 0).z : 2 * velocity(solver, 0).z;
  // The dashpot acts with the velocity of half a step ago, an error of z/steps_a_unit; begin and end of the
  // force are met within a step each.
  CHECK(rebound == Approx(exact.restitution() * speed).epsilon(1.0 / steps_a_unit));
  CHECK(pushing * c.step == Approx(exact.time() * unit).epsilon(2.0 / steps_a_unit));
}

namespace {

/// Stiff enough that the rolling radius is R, damped enough that nothing bounces.
constexpr SphereCase ball{
    .radius = 0.1, .youngs_modulus = 1e9, .restitution = 0.3, .friction = 0.6, .step = 5e-6};

double resting_overlap(const SphereCase& c, double weight) {
  const double modulus = effective_moduli(c.material(), rigid()).normal;
  return std::pow(3 * weight / (4 * modulus * std::sqrt(c.radius)), 2.0 / 3);
}

/// A ball that rests in its overlap on a plane tilted by `angle`, and begins to roll with a speed.
struct RollingStart {
  LawChoice::Rolling kind;
  RollingCoefficients rolling;
  double angle = 0, speed = 0;
};
ParticleModel rolling_ball(const RollingStart& start) {
  ParticleModel model = model_of(ball, rigid());
  model.law.rolling = start.kind;
  PairParameters p = model.pairs(0, 1);
  set_rolling(p, start.rolling);
  model.pairs.set(0, 1, p);
  model.gravity = {g * std::sin(start.angle), 0, -g * std::cos(start.angle)};
  model.planes = {floor()};
  const double height = ball.radius - resting_overlap(ball, ball.mass() * g * std::cos(start.angle));
  model.spheres = {ball.sphere({0, 0, height}, {start.speed, 0, 0}, {0, start.speed / height, 0})};
  return model;
}

/// m/s^2; between two times after the start, so that the springs' first wind-up is left out.
double acceleration(ParticleSolver& solver) {
  const int early = 10'000, late = 30'000;
  double early_speed = 0;
  for (int n = 1; n <= late; ++n) {
    solver.step();
    if (n == early) early_speed = velocity(solver, 0).x;
  }
  return (velocity(solver, 0).x - early_speed) / ((late - early) * ball.step);
}

}  // namespace

TEST_CASE("Rolling resistance of either kind slows a rolling sphere by 5/7 mu_r g") {
  const auto kind = GENERATE(LawChoice::Rolling::constant_torque, LawChoice::Rolling::elastic_plastic);
  const double mu = GENERATE(0.01, 0.05);
  ParticleSolver solver(
      rolling_ball({.kind = kind, .rolling = {.friction = mu, .damping = 0.3}, .speed = 1}));
  // Torque mu_r R m g on the inertia 7/5 m R^2 about the contact point. The overlap is 2e-4 of the radius.
  CHECK(acceleration(solver) == Approx(-5.0 / 7 * mu * g).epsilon(2e-3));
}

TEST_CASE("A constant rolling torque brings a sphere to rest without rocking it") {
  const double mu = 0.2, speed = 0.2, time = speed / (5.0 / 7 * mu * g);
  ParticleSolver solver(rolling_ball(
      {.kind = LawChoice::Rolling::constant_torque, .rolling = {.friction = mu}, .speed = speed}));
  while (solver.time() < 1.1 * time) solver.step();
  // What is left is the wobble of the tangential spring, which rolling resistance does not damp.
  double fastest = 0;
  for (int n = 0; n < 2000; ++n) {
    solver.step();
    fastest = std::max(fastest, std::abs(spin(solver, 0).y) * ball.radius);
  }
  CHECK(fastest < 0.01 * speed);
  CHECK(position(solver, 0).x == Approx(0.5 * speed * time).epsilon(0.01));
}

TEST_CASE("Elastic-plastic rolling resistance holds a sphere on a slope below mu_r and lets it roll above") {
  const double mu = 0.1;
  const double slope = GENERATE(0.05, 0.09, 0.11, 0.2);
  const double angle = std::atan(slope);
  ParticleSolver solver(rolling_ball({.kind = LawChoice::Rolling::elastic_plastic,
                                      .rolling = {.friction = mu, .damping = 0.8},
                                      .angle = angle}));
  const double exact = slope < mu ? 0 : 5.0 / 7 * g * (std::sin(angle) - mu * std::cos(angle));
  CHECK(acceleration(solver) == Approx(exact).epsilon(0.01).margin(1e-3 * g));
}

TEST_CASE("The elastic rolling spring rocks a sphere at its own frequency and damping") {
  const double mu = 0.02, damping = GENERATE(0.0, 0.1);
  const double overlap = resting_overlap(ball, ball.mass() * g);
  const double modulus = effective_moduli(ball.material(), rigid()).normal;
  const double kn = 2 * modulus * std::sqrt(ball.radius * overlap);
  const double kr = 2.25 * kn * std::pow(mu * ball.radius, 2);  // Ai et al. 2011, eq. 21
  const double inertia = 1.4 * ball.mass() * ball.radius * ball.radius;
  const double frequency = std::sqrt(kr / inertia);
  const double yield = mu * ball.radius * ball.mass() * g;
  const double spin_start = 0.3 * yield / std::sqrt(kr * inertia);
  ParticleSolver solver(rolling_ball({.kind = LawChoice::Rolling::elastic_plastic,
                                      .rolling = {.friction = mu, .damping = damping},
                                      .speed = spin_start * ball.radius}));
  // The spin changes its sign a quarter, three quarters, ... of a period after the start; damped, the first
  // change comes earlier by arcsin(damping).
  std::vector<double> crossings, peaks;
  double last = spin(solver, 0).y, peak = 0;
  while (crossings.size() < 4) {
    solver.step();
    const double now = spin(solver, 0).y;
    if ((now > 0) != (last > 0)) {
      crossings.push_back(solver.time());
      peaks.push_back(peak);
      peak = 0;
    }
    peak = std::max(peak, std::abs(now));
    last = now;
  }
  const double damped = std::sqrt(1 - damping * damping);
  // The tangential spring in series with the rolling one adds kr/(kt R^2) ~ mu_r^2 to the compliance.
  CHECK((crossings[3] - crossings[1]) == Approx(2 * pi / (frequency * damped)).epsilon(3e-3));
  CHECK(peaks[3] / peaks[1] == Approx(std::exp(-2 * pi * damping / damped)).epsilon(0.02));
}

TEST_CASE("Friction that falls with speed slows the slip along its closed form") {
  const double at_rest = 0.6, sliding = 0.2, decay = 0.8, start = 2;
  ParticleModel model = model_of(ball, rigid());
  model.law.friction = LawChoice::FrictionKind::falling;
  PairParameters p = model.pairs(0, 1);
  set_friction(p, {.at_rest = at_rest, .sliding = sliding, .decay_speed = decay});
  model.pairs.set(0, 1, p);
  model.gravity = {0, 0, -g};
  model.planes = {floor()};
  const double height = ball.radius - resting_overlap(ball, ball.mass() * g);
  model.spheres = {ball.sphere({0, 0, height}, {start, 0, 0})};
  ParticleSolver solver(model);
  const double end = 0.15;
  while (solver.time() < end) solver.step();
  // The slip u of a sphere obeys du/dt = -7/2 mu(u) g; with y = exp(u/decay) that is linear:
  // dy/dt = -7/2 g/decay (mu_d y + mu_s - mu_d).
  const double excess = (at_rest - sliding) / sliding;
  const double y = (std::exp(start / decay) + excess) * std::exp(-3.5 * g * sliding / decay * end) - excess;
  const double slip = velocity(solver, 0).x - height * spin(solver, 0).y;
  REQUIRE(y > 1);
  // The tangential spring is wound up first, and the ball sinks in by 2e-4 R when it brakes.
  CHECK(slip == Approx(decay * std::log(y)).margin(1e-3 * start));
}
