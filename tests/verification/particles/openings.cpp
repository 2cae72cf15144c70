#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "interface_mesh/net_patterns.hpp"
#include "tests/verification/particles/particle_models.hpp"

/// Spheres that fall on nets held fast: the opening of a net's data sheet decides which of them pass.
using namespace talus;

namespace {

constexpr int rows = 16;  ///< of as many spheres each
constexpr unsigned showers = 4;
constexpr int all = rows * rows * showers;
/// Of the opening. A sphere that falls by its radius onto four wires squeezes itself between them by less
/// than half of that (Hertz: 4 x 0.4 x 4/3 E* sqrt(R*) d^2.5 = m g R).
constexpr double margin = 0.02;

/// Where in a cell of the pattern the spheres start.
struct Start {
  double from = 0, to = 1;  ///< parts of the cell, along and across
};

/// A group of cells in which a sphere meets none of another group.
double group_size(double cell, double diameter, const Start& start) {
  return cell * std::ceil(start.to - start.from + 1.5 * diameter / cell);
}

constexpr double gravity = 9.81;  ///< m/s^2

/// Stiff spheres, and a step that resolves their fall by a radius in ten parts of the contact.
dem::cases::SphereCase sphere_of(double diameter) {
  dem::cases::SphereCase c{.radius = diameter / 2, .youngs_modulus = 1e9, .restitution = 0.3};
  const double modulus = c.youngs_modulus / (1 - c.poissons_ratio * c.poissons_ratio);
  const dem::cases::HertzCollision fall{c.radius, c.mass(), modulus, std::sqrt(2 * gravity * c.radius)};
  c.step = fall.duration() / 10;
  return c;
}

/// Spheres of one diameter at rest just above the net, without friction, each at a random place of its own
/// group of cells.
dem::ParticleModel shower(const mesh::Lattice& lattice, double diameter, const Start& start, unsigned seed) {
  const auto c = sphere_of(diameter);
  auto model = dem::cases::model_of(c, dem::cases::rigid());
  const double group_x = group_size(lattice.cell.x(), diameter, start),
               group_y = group_size(lattice.cell.y(), diameter, start);
  const auto panel =
      mesh::make_panel(mesh::Rectangle{core::Vector3::Zero(), core::Vector3::UnitX(), core::Vector3::UnitY(),
                                       (rows + 1) * group_x, (rows + 1) * group_y});
  const auto net = mesh::clip(lattice, panel).surface;
  model.boundary = dem::Boundary(net, std::vector<dem::Index>(net.parts.size(), 1));
  model.gravity = {0, 0, -gravity};
  double thickest = 0;
  for (const auto& part : net.parts) thickest = std::max(thickest, part.wire_radius);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> in_cell(start.from, start.to);
  for (int k = 0; k < rows * rows; ++k) {
    const double x = (k % rows + 1) * group_x + in_cell(random) * lattice.cell.x();
    const double y = (k / rows + 1) * group_y + in_cell(random) * lattice.cell.y();
    model.spheres.push_back(c.sphere({x, y, diameter / 2 + thickest}, {}));
  }
  return model;
}

struct Fall {
  double diameter = 0;  ///< m
  double time = 0;      ///< sqrt(R/g)
};

int count_below(const dem::ParticleSolver& solver, double height) {
  return int(std::ranges::count_if(solver.spheres().position, [&](const auto& p) { return p.z < height; }));
}

/// How many are below the net before the time is over, in units of sqrt(R/g).
int count_fallen_through(const mesh::Lattice& lattice, const Start& start, const Fall& fall) {
  const double end = fall.time * std::sqrt(fall.diameter / 2 / gravity);
  int fallen = 0;
  for (unsigned seed = 1; seed <= showers; ++seed) {
    dem::ParticleSolver solver(shower(lattice, fall.diameter, start, seed));
    while (solver.time() < end && count_below(solver, -fall.diameter) < rows * rows) solver.step();
    fallen += count_below(solver, -fall.diameter / 2);
  }
  return fallen;
}

/// A sphere balanced beside a wire at the distance x falls off like x exp(t sqrt(g/R)): in 16 units from a
/// millionth of its radius. The fall by a radius that presses a sphere between wires hardest takes 1.4 units.
template <class Pattern>
void check_opening(const Pattern& pattern, const Start& start = {}) {
  const double opening = mesh::opening(pattern);
  const Fall smaller{.diameter = (1 - margin) * opening, .time = 16};
  const Fall larger{.diameter = (1 + margin) * opening, .time = 6};
  CHECK(count_fallen_through(lattice(pattern), start, smaller) == all);
  CHECK(count_fallen_through(lattice(pattern), start, larger) == 0);
}

}  // namespace

TEST_CASE(
    "through a square net fall all spheres slightly smaller than its opening and none slightly larger") {
  check_opening(mesh::SquarePattern{.pitch = 0.1, .wire_diameter = 0.004});
}

TEST_CASE(
    "through a chain-link net fall all spheres slightly smaller than its opening and none slightly larger") {
  check_opening(mesh::RhombicPattern{.diagonals = {0.083, 0.143}, .wire_diameter = 0.003});
}

TEST_CASE(
    "through a double-twist net fall all spheres slightly smaller than its opening and none slightly "
    "larger") {
  check_opening(
      mesh::HexagonalPattern{.mesh_size = {0.08, 0.1}, .twist_length = 0.04, .wire_diameter = 0.0027});
}

TEST_CASE(
    "through the rings they start over fall all spheres slightly smaller than a ring net's opening, none "
    "larger") {
  // Between four rings a smaller sphere comes to rest: the opening of the data sheet is that of a ring.
  check_opening(mesh::RingPattern{.inner_diameter = 0.3, .wire_diameter = 0.003, .windings = 12},
                {.from = 0.35, .to = 0.65});
}
