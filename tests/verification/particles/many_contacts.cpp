#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <cmath>

#include "core/errors.hpp"
#include "dem_solver/scene/rock_scene.hpp"
#include "tests/verification/particles/particle_models.hpp"

using namespace talus;
using namespace talus::dem;
using namespace talus::dem::cases;

namespace {

using Normal = LawChoice::Normal;

struct Law {
  Normal kind = Normal::hertz;
  double restitution = 0.5;
};

constexpr double modulus = 1e8;             // Pa, E* of Hertz's laws
constexpr double spring = 1e6;              // N/m, of the linear law
constexpr double foundation_modulus = 1e8;  // Pa/m

PairParameters parameters_of(const Law& law) {
  const EffectiveModuli moduli{modulus, modulus / 3};
  switch (law.kind) {
    case Normal::hertz:
      return pair_parameters(HertzContact{law.restitution}, moduli);
    case Normal::hysteretic_hertz:
      return pair_parameters(HystereticContact{law.restitution}, moduli);
    case Normal::linear:
      return pair_parameters(LinearContact{spring, 1, law.restitution});
    case Normal::foundation:
      break;
  }
  return pair_parameters(FoundationContact{foundation_modulus, 1, law.restitution});
}

const char* name_of(Normal kind) {
  switch (kind) {
    case Normal::hertz:
      return "hertz";
    case Normal::hysteretic_hertz:
      return "hysteretic";
    case Normal::linear:
      return "linear";
    case Normal::foundation:
      break;
  }
  return "foundation";
}

ParticleModel empty_model(const Law& law) {
  ParticleModel model;
  model.law.normal = law.kind;
  model.law.ledger = true;
  model.pairs = PairTable(2);
  model.pairs.set(0, 0, parameters_of(law));
  model.pairs.set(0, 1, parameters_of(law));
  return model;
}

/// Adds a rock of equal balls at places given from its centre.
struct Body {
  double mass = 100;
  Triple<double> moments{10, 10, 10};
  Triple<double> centre, velocity, spin;
  std::vector<Triple<double>> balls;
  double radius = 0.05, area = 0.01;
};
void add_body(ParticleModel& model, const Body& body) {
  const auto number = static_cast<Index>(model.rocks.size());
  model.rocks.push_back({.mass = body.mass,
                         .moments = body.moments,
                         .centre = body.centre,
                         .velocity = body.velocity,
                         .spin = body.spin,
                         .name = "body" + std::to_string(number)});
  for (const Triple<double>& ball : body.balls)
    model.spheres.push_back({.position = body.centre + ball,
                             .velocity = body.velocity + cross(body.spin, ball),
                             .spin = body.spin,
                             .radius = body.radius,
                             .mass = body.mass,
                             .material = 0,
                             .rock = number,
                             .area = body.area,
                             .facing = {}});
}

/// A square plate on n x n balls that comes down flat.
Body plate(int n, double speed) {
  Body body{.centre = {0, 0, 0.051}, .velocity = {0, 0, -speed}};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      body.balls.push_back({0.2 * (i - 0.5 * (n - 1)), 0.2 * (j - 0.5 * (n - 1)), 0});
  return body;
}

/// Runs until no sphere touches any more after one has. @return the largest force on the first rock along z, N
double until_free(ParticleSolver& solver) {
  double largest = 0;
  bool touched = false;
  for (int n = 0; n < 2'000'000; ++n) {
    solver.step();
    double stiffness = 0;
    for (const Row& force : solver.spheres().force) stiffness += force.w;
    largest = std::max(largest, solver.rocks().force(0).z);
    if (stiffness > 0) touched = true;
    if (touched && stiffness == 0) return largest;
  }
  FAIL("the body does not come free");
  return 0;
}

/// s; a small part of the period of the plate on all its balls. Linear dashpots begin at their full strength, so that the phase of
/// the first touch within a step counts.
double short_step(const Law& law, int balls, double mass) {
  const double stiffness = law.kind == Normal::linear       ? balls * spring
                           : law.kind == Normal::foundation ? balls * foundation_modulus * 0.01
                                                            : balls * 2 * modulus * std::sqrt(0.05 * 1e-3);
  const double stiffer = parameters_of(law).normal.z;
  const bool hysteretic = law.kind == Normal::foundation || law.kind == Normal::hysteretic_hertz;
  return 2 * std::numbers::pi * std::sqrt(mass / stiffness * (hysteretic ? stiffer : 1)) /
         (law.kind == Normal::linear ? 4000 : 1000);
}

}  // namespace

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

namespace {

constexpr double block_edge_length = 0.4, drop_speed = 0.5;

/// A block that falls on a plane, its lowest point first as it is turned, or on wires along x.
struct Drop {
  core::Vector3 turned = core::Vector3::Zero();
  std::vector<double> wires;  ///< m; their places along y; none: a plane
};
struct BlockImpact {
  double force = 0;  ///< N; the largest
  double speed = 0;  ///< over that of the drop
  double mass = 0;   ///< kg
  double lost = 0;   ///< what the ledger misses, over the impact's energy
};

Boundary wires_at(const std::vector<double>& places) {
  mesh::Surface surface;
  for (const double y : places) {
    const auto first = static_cast<mesh::Index>(surface.node_count());
    surface.positions.insert(surface.positions.end(), {-1, y, -0.01, 1, y, -0.01});
    surface.segments.push_back({first, first + 1});
  }
  surface.parts = {
      {.name = "wires", .wire_radius = 0.01, .segment_end = static_cast<mesh::Index>(places.size())}};
  return Boundary(surface, std::vector<Index>{1});
}

BlockImpact impact_of(const Drop& drop, double spacing) {
  RockScene scene;
  scene.shape =
      BlockScene{.edge = block_edge_length, .mass = {}, .cut = 0.25, .deviation = {}, .spacing = spacing};
  scene.at = {0, 0, 1};
  scene.turned = drop.turned;
  scene.velocity = {0, 0, -drop_speed};
  BuiltRock built = build_rock("block", scene, 2600);
  double lowest = 1;
  for (const SphereInput& sphere : built.spheres)
    lowest = std::min(lowest, sphere.position.z - sphere.radius);
  ParticleModel model = empty_model({Normal::foundation, 0.5});
  if (drop.wires.empty())
    model.planes = {floor()};
  else
    model.boundary = wires_at(drop.wires);
  model.step = 1e-5;
  built.rock.centre.z += 0.001 - lowest;
  for (SphereInput sphere : built.spheres) {
    sphere.position.z += 0.001 - lowest;
    sphere.rock = 0;
    model.spheres.push_back(sphere);
  }
  model.rocks = {built.rock};
  ParticleSolver solver(model);
  const double before = solver.ledger().balance();
  BlockImpact result{.force = until_free(solver),
                     .speed = solver.rocks().velocity(0).z / drop_speed,
                     .mass = built.rock.mass};
  result.lost = std::abs(solver.ledger().balance() / before - 1);
  return result;
}

}  // namespace

TEST_CASE(
    "A block flat on its face meets a plane with the stiffness of that face, however its spheres are "
    "spaced") {
  const double spacing = GENERATE(0.1, 0.05, 0.025);
  const BlockImpact rebound = impact_of({}, spacing);
  // An octagon; the largest force of a mass on a spring is v sqrt(k m), k = k_A A. What the slanting faces beside it add as they
  // come down is in the order of overlap over edge, 1 %.
  const double face = block_edge_length * block_edge_length * (1 - 2 * 0.25 * 0.25);
  CHECK(rebound.force ==
        Approx(drop_speed * std::sqrt(foundation_modulus * face * rebound.mass)).epsilon(0.015));
  CHECK(rebound.speed == Approx(0.5).epsilon(1e-3));
  CHECK(rebound.lost < 1e-3);
}

namespace {

/// N; the largest force on a foundation, whose force is k_A times the volume below the plane, found on a grid of points of the
/// turned block: cube |x|, |y|, |z| < a/2 and |x| + |y| + |z| < 3/2 a - cut.
double largest_force_on_plane(const core::Vector3& turned, double mass) {
  const double a = block_edge_length, cut = 0.25 * a, cell = a / 200, slice = a / 1000;
  const Eigen::Matrix3d back =
      turned.norm() > 0 ? Eigen::AngleAxisd(turned.norm(), turned.normalized()).toRotationMatrix().transpose()
                        : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  const auto area = [&](double z) {
    double sum = 0;
    for (double x = -a + 0.5 * cell; x < a; x += cell)
      for (double y = -a + 0.5 * cell; y < a; y += cell) {
        const core::Vector3 p = (back * core::Vector3(x, y, z)).cwiseAbs();
        if (p.maxCoeff() < a / 2 && p.sum() < 1.5 * a - cut) sum += cell * cell;
      }
    return sum;
  };
  double z = -a;
  while (area(z) == 0) z += slice;
  double volume = 0, work = 0;
  for (; work < 0.5 * mass * drop_speed * drop_speed; z += slice) {
    volume += area(z + 0.5 * slice) * slice;
    work += foundation_modulus * volume * slice;
  }
  return foundation_modulus * volume;
}

}  // namespace

TEST_CASE(
    "On an edge, a corner's face and wires a block's force approaches that of a foundation as spheres are "
    "set closer") {
  const double quarter = std::numbers::pi / 4, diagonal = std::acos(1 / std::sqrt(3.0));
  const auto [what, drop] = GENERATE_COPY(table<const char*, Drop>(
      {{"an edge", Drop{.turned = {quarter, 0, 0}, .wires = {}}},
       {"a corner's face",
        Drop{.turned = core::Vector3(1, -1, 0).normalized() * (std::numbers::pi - diagonal), .wires = {}}},
       {"three wires", Drop{.turned = {0, 0, 0}, .wires = {-0.1, 0, 0.1}}}}));
  INFO(what);
  std::vector<double> errors;
  for (const double spacing : {0.05, 0.025, 0.0125}) {
    const BlockImpact impact = impact_of(drop, spacing);
    // Three wires under the whole width of the face: strips of 20 mm x 400 mm.
    const double force =
        drop.wires.empty()
            ? largest_force_on_plane(drop.turned, impact.mass)
            : drop_speed * std::sqrt(foundation_modulus * 3 * 0.02 * block_edge_length * impact.mass);
    errors.push_back(impact.force / force - 1);
    CHECK(impact.speed == Approx(0.5).epsilon(0.01));
    CHECK(impact.lost < 1e-6);
  }
  INFO("errors " << errors[0] << " " << errors[1] << " " << errors[2]);
  CHECK(std::abs(errors[1]) < 0.75 * std::abs(errors[0]));
  CHECK(std::abs(errors[2]) < 0.75 * std::abs(errors[1]));
  CHECK(std::abs(errors[2]) < 0.15);
}

TEST_CASE(
    "Every law with and without friction on planes and faces by both rules closes the ledger of a tumbling "
    "block") {
  const Normal kind = GENERATE(Normal::hertz, Normal::linear, Normal::hysteretic_hertz, Normal::foundation);
  const double friction = GENERATE(0.0, 0.4);
  const bool on_faces = GENERATE(false, true);
  const ContactRule rule =
      on_faces ? GENERATE(ContactRule::local_minima, ContactRule::tangent_plane) : ContactRule::local_minima;
  RockScene scene;
  scene.shape = BlockScene{.edge = 0.4, .mass = {}, .cut = {}, .deviation = {}, .spacing = 0.1};
  scene.at = {0.1, -0.05, 0.36};
  scene.turned = {0.5, 0.3, 0.2};
  // Fast enough for the smallest balls, of some 20 mm beside an edge, to be pressed deeper than their radius: a face goes on pushing as
  // a plane does.
  scene.velocity = {1, 0.5, -2};
  scene.spin = {2, -1, 1};
  const BuiltRock built = build_rock("block", scene, 2600);
  ParticleModel model = empty_model({kind, 0.4});
  if (friction > 0) {
    PairParameters p = model.pairs(0, 1);
    set_friction(p, {.at_rest = friction, .sliding = friction});
    model.pairs.set(0, 1, p);
    model.law.friction = LawChoice::FrictionKind::constant;
  }
  model.gravity = {0, 0, -9.81};
  model.contact_rule = rule;
  if (on_faces) {
    mesh::Surface ground;
    ground.positions = {-3, -3, 0, 3, -3, 0, 3, 3, 0, -3, 3, 0};
    ground.triangles = {{0, 1, 2}, {0, 2, 3}};
    ground.parts = {{.name = "ground", .triangle_end = 2}};
    model.boundary = Boundary(ground, std::vector<Index>{1});
  } else {
    model.planes = {floor()};
  }
  model.step = 1e-5;
  model.rocks = {built.rock};
  for (SphereInput sphere : built.spheres) {
    sphere.rock = 0;
    model.spheres.push_back(sphere);
  }
  ParticleSolver solver(model);
  const double start = solver.ledger().balance();
  for (int n = 0; n < 30'000; ++n) solver.step();
  INFO(name_of(kind) << ", friction " << friction << (on_faces ? ", faces" : ", plane"));
  CHECK(solver.ledger().damping > 0.05 * start);  // it has met the ground
  // What the impact leaves to second order in the step, 1e-5 s in contacts of some ms.
  CHECK(solver.ledger().balance() == Approx(start).epsilon(1e-3));
}
