#include <array>
#include <catch2/catch.hpp>
#include <random>
#include <utility>

#include "tests/verification/particles/particle_models.hpp"

using namespace talus;
using namespace talus::dem;
using namespace talus::dem::cases;

namespace {

constexpr double speed = 40;            // m/s
constexpr double wire_radius = 0.0015;  // m; wires of 3 mm

/// Shots at random points of the square [0, side]^2 of z = 0, each from its own random direction. They do not
/// see each other: between stones the contact law is left without stiffness.
struct Volley {
  double side = 6;      ///< m
  double steepest = 0;  ///< largest tangent of the angle to the normal, along either side
  static constexpr int shots = 10'000;
  static constexpr double highest_node = 0.005;  ///< m; of the targets

  /// m; where a stone starts at most, so that it meets the target at any moment of its step.
  static double top(const SphereCase& c) { return c.radius + wire_radius + highest_node + speed * c.step; }

  std::vector<SphereInput> of(const SphereCase& c) const {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<SphereInput> volley;
    for (int k = 0; k < shots; ++k) {
      Triple<double> v{steepest * u(random), steepest * u(random), -1};
      v = (speed / length(v)) * v;
      const Triple<double> aim{0.5 * side * (1 + u(random)), 0.5 * side * (1 + u(random)), 0};
      const double height = top(c) - 0.5 * speed * c.step * (1 + u(random));
      volley.push_back(c.sphere(aim + (height / v.z) * v, v));
    }
    return volley;
  }
};

/// Stiff stone, at a twelfth of the collision's duration a step: coarser than the check of a scene allows
/// without a warning.
SphereCase stone(double radius) {
  SphereCase c{.radius = radius, .youngs_modulus = 4e9, .restitution = 0.5, .friction = 0.4};
  c.step =
      HertzCollision{c.radius, c.mass(), effective_moduli(c.material(), rigid()).normal, speed}.duration() /
      12;
  return c;
}

/// A spring so soft that a stone sinks in by two thirds of its radius, and the step at a share of the limit that
/// `talus check` states, (R + r_w)/(2 v): half of a radius on the way into the first contact.
SphereCase soft_stone(double radius, double wire, double share_of_limit) {
  SphereCase c{.radius = radius, .restitution = 0.5, .friction = 0.4};
  c.step = share_of_limit * (radius + wire) / (2 * speed);
  return c;
}
LinearContact soft_spring(const SphereCase& c) {
  const double frequency = 1.5 * speed / c.radius;
  return {.stiffness = c.mass() * frequency * frequency, .restitution = c.restitution};
}

/// A wall without holes: a grid of nodes shaken in the plane, each cell cut along a random diagonal. It
/// reaches further than the volley on all sides.
mesh::Surface shaken_wall(double side, double cell) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> u(-1, 1);
  mesh::Surface wall;
  const int n = static_cast<int>(std::ceil(side / cell)) + 8;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      wall.positions.insert(wall.positions.end(),
                            {(i - 4 + 0.3 * u(random)) * cell, (j - 4 + 0.3 * u(random)) * cell,
                             Volley::highest_node * u(random)});
  const auto node = [n](int i, int j) { return static_cast<mesh::Index>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const mesh::Index a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if (u(random) > 0) {
        wall.triangles.push_back({a, b, c});
        wall.triangles.push_back({a, c, d});
      } else {
        wall.triangles.push_back({a, b, d});
        wall.triangles.push_back({b, c, d});
      }
    }
  wall.parts = {{.name = "wall", .triangle_end = static_cast<mesh::Index>(wall.triangles.size())}};
  return wall;
}

/// Wires along all grid lines of a pitch, cut at the crossings.
mesh::Surface wire_net(double side, double pitch) {
  mesh::Surface net;
  const int n = static_cast<int>(std::ceil(side / pitch)) + 8;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      net.positions.insert(net.positions.end(), {(i - 4) * pitch, (j - 4) * pitch, 0.0});
      const mesh::Index here = i * (n + 1) + j;
      if (i < n) net.segments.push_back({here, here + n + 1});
      if (j < n) net.segments.push_back({here, here + 1});
    }
  net.parts = {{.name = "net",
                .wire_radius = wire_radius,
                .segment_end = static_cast<mesh::Index>(net.segments.size())}};
  return net;
}

ParticleSolver shoot(ParticleModel model, const SphereCase& c, const mesh::Surface& target,
                     const Volley& volley) {
  model.boundary = Boundary(target, std::array<Index, 1>{1});
  model.spheres = volley.of(c);
  model.pairs.set(0, 0, {});
  model.skin = 0.5 * c.radius;  // fast flight uses up a thin one in a few steps
  ParticleSolver solver(model);
  // Down to the target and as far again, and two contacts of 12 steps or fewer.
  const double flight = 2 * Volley::top(c) / speed * std::hypot(1, volley.steepest, volley.steepest);
  const double contact = 12 * c.step;
  while (solver.time() < flight + 2 * contact) solver.step();
  return solver;
}
ParticleSolver shoot(const SphereCase& c, const mesh::Surface& target, const Volley& volley) {
  return shoot(model_of(c, rigid()), c, target, volley);
}
ParticleSolver shoot_soft(const SphereCase& c, const mesh::Surface& target, const Volley& volley) {
  ParticleModel model = model_of(c, rigid());
  model.law.normal = LawChoice::Normal::linear;
  PairParameters p = pair_parameters(soft_spring(c));
  set_friction(p, {.at_rest = c.friction, .sliding = c.friction});
  model.pairs.set(0, 1, p);
  return shoot(std::move(model), c, target, volley);
}

int passed(const ParticleSolver& solver) {
  int count = 0;
  for (const Row& p : solver.spheres().position) count += p.z < 0;
  return count;
}

int rebounded(const ParticleSolver& solver) {
  int count = 0;
  for (const Row& v : solver.spheres().velocity) count += v.z > 0;
  return count;
}

}  // namespace

TEST_CASE("None of 10 000 stones of 4 cm passes a wall of triangles in steps of a twelfth of the contact") {
  const Volley volley{.steepest = 1.5};
  const ParticleSolver solver = shoot(stone(0.02), shaken_wall(volley.side, 0.1), volley);
  REQUIRE(solver.spheres().size() == 10'000);
  CHECK(passed(solver) == 0);
  // One that grazes a slope may go on downhill.
  CHECK(rebounded(solver) > 0.999 * Volley::shots);
}

TEST_CASE(
    "None of 10 000 stones of 4 cm passes a net of 3 cm openings in steps of a twelfth of the contact") {
  const Volley volley{.steepest = 1.5};
  const double pitch = 0.03 + 2 * wire_radius;
  const ParticleSolver solver = shoot(stone(0.02), wire_net(volley.side, pitch), volley);
  REQUIRE(solver.spheres().size() == 10'000);
  CHECK(passed(solver) == 0);
}

TEST_CASE("None of 10 000 stones passes at 0.95 of the tunnelling limit, some do at three times the limit") {
  const Volley volley{.steepest = 1.5};
  const bool wires = GENERATE(false, true);
  const double thickness = wires ? wire_radius : 0;
  const mesh::Surface target =
      wires ? wire_net(volley.side, 0.03 + 2 * wire_radius) : shaken_wall(volley.side, 0.1);
  CAPTURE(wires);
  const ParticleSolver below = shoot_soft(soft_stone(0.02, thickness, 0.95), target, volley);
  CHECK(below.step_length() * 2 * speed == Approx(0.95 * (0.02 + thickness)));
  CHECK(passed(below) == 0);
  CHECK(rebounded(below) > 0.98 * Volley::shots);
  CHECK(passed(shoot_soft(soft_stone(0.02, thickness, 3), target, volley)) > 100);
}

namespace {

/// m; from the straight path of a sphere to the nearest wire of a net of grid lines in z = 0. The distance of
/// two lines p + s v and q + t a is |(p - q) . (v x a)|/|v x a|.
double distance_to_wires(const SphereInput& shot, double pitch) {
  const auto to_lines = [pitch](double across, double along_across, double z, double along_z) {
    // In the plane across a family of lines: they are points at multiples of the pitch on z = 0.
    double nearest = 1e9;
    const double at_net = across - z / along_z * along_across;
    for (const double line : {std::floor(at_net / pitch) * pitch, std::ceil(at_net / pitch) * pitch}) {
      const double offset = std::abs((across - line) * along_z - z * along_across);
      nearest = std::min(nearest, offset / std::hypot(along_z, along_across));
    }
    return nearest;
  };
  const auto &p = shot.position, &v = shot.velocity;
  return std::min(to_lines(p.x, v.x, p.z, v.z), to_lines(p.y, v.y, p.z, v.z));
}

}  // namespace

TEST_CASE("Stones of 2 cm that pass an opening of 8 cm without touching keep their velocity to the bit") {
  const Volley volley{.steepest = 0.6};
  const SphereCase c = stone(0.01);
  const double pitch = 0.08 + 2 * wire_radius;
  const std::vector<SphereInput> shots = volley.of(c);
  ParticleSolver solver = shoot(c, wire_net(volley.side, pitch), volley);
  int free = 0, hit = 0;
  for (Index id = 0; id < solver.spheres().size(); ++id) {
    const double gap = distance_to_wires(shots[id], pitch) - c.radius - wire_radius;
    const bool unchanged = length(velocity(solver, id) - shots[id].velocity) == 0;
    const double slack = 1e-9;  // round-off of the flight
    if (gap > slack) {
      ++free;
      CHECK(unchanged);
      CHECK(position(solver, id).z < 0);
    }
    if (gap < -1e-5) {  // deep enough to last more than a step
      ++hit;
      CHECK_FALSE(unchanged);
    }
  }
  CHECK(free > 1'000);
  CHECK(hit > 1'000);
}
