#include <catch2/catch.hpp>

#include <array>
#include <random>

#include "tests/verification/particles/particle_models.hpp"

using namespace talus;
using namespace talus::dem;
using namespace talus::dem::cases;

namespace {

/// The square [-1, 1]^2 in z = 0 as eight triangles around the origin: faces, shared edges, diagonal edges
/// and a vertex of eight.
mesh::Surface eight_triangles() {
  mesh::Surface surface;
  surface.positions = {0, 0, 0};
  for (const auto& [x, y] : {std::pair{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}})
    surface.positions.insert(surface.positions.end(), {1.0 * x, 1.0 * y, 0.0});
  for (mesh::Index k = 0; k < 8; ++k) surface.triangles.push_back({0, k + 1, (k + 1) % 8 + 1});
  surface.parts = {{.name = "floor", .triangle_end = 8}};
  return surface;
}

struct Throw {
  const char* where;
  Triple<double> from, velocity;
};

Triple<double> end_position(const SphereCase& c, const Throw& thrown, bool triangles) {
  ParticleModel model = model_of(c, rigid());
  model.gravity = {0, 0, -9.81};
  const std::array<Index, 1> material{1};
  if (triangles)
    model.boundary = Boundary(eight_triangles(), material);
  else
    model.planes = {floor()};
  model.spheres = {c.sphere(thrown.from, thrown.velocity, {1, 2, 3})};
  ParticleSolver solver(model);
  while (solver.time() < 0.3) solver.step();
  return position(solver, 0);
}

}  // namespace

TEST_CASE("A triangulated floor acts like the plane it fills, on faces, edges, vertices and across them") {
  const SphereCase c{.radius = 0.1, .youngs_modulus = 1e7, .restitution = 0.5, .friction = 0.4, .step = 2e-5};
  const double rest = 0.0999;
  const Throw thrown =
      GENERATE_COPY(Throw{"face", {0.5, 0.2, 0.12}, {}}, Throw{"shared edge", {0.5, 0, 0.12}, {}},
                    Throw{"diagonal edge", {0.5, 0.5, 0.12}, {}}, Throw{"vertex of eight", {0, 0, 0.12}, {}},
                    Throw{"rolling across all", {-0.4, -0.17, rest}, {3, 1.1, 0}});
  INFO(thrown.where);
  const Triple<double> difference = end_position(c, thrown, true) - end_position(c, thrown, false);
  CHECK(length(difference) < 1e-6 * c.radius);
}

namespace {

/// A sphere falls into a net of wires; the net is given in the order of `shuffle` and turned by a rotation
/// about (1, 1, 1).
Triple<double> end_on_net(bool shuffled, bool turned) {
  // The cyclic permutation x -> y -> z is the rotation by 120 degrees, free of round-off of its own.
  const auto turn = [turned](Triple<double> p) { return turned ? Triple<double>{p.z, p.x, p.y} : p; };
  mesh::Surface net;
  const int n = 5;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Triple<double> p = turn({0.05 * i, 0.05 * j, 0.002 * ((i * 7 + j * 3) % 5)});
      net.positions.insert(net.positions.end(), {p.x, p.y, p.z});
      if (i + 1 < n) net.segments.push_back({i * n + j, (i + 1) * n + j});
      if (j + 1 < n) net.segments.push_back({i * n + j, i * n + j + 1});
    }
  if (shuffled) std::shuffle(net.segments.begin(), net.segments.end(), std::mt19937(3));
  net.parts = {
      {.name = "net", .wire_radius = 0.002, .segment_end = static_cast<mesh::Index>(net.segments.size())}};
  const SphereCase c{
      .radius = 0.04, .youngs_modulus = 1e7, .restitution = 0.5, .friction = 0.4, .step = 1e-5};
  ParticleModel model = model_of(c, rigid());
  model.gravity = turn({0, 0, -9.81});
  const std::array<Index, 1> material{1};
  model.boundary = Boundary(net, material);
  model.spheres = {c.sphere(turn({0.083, 0.107, 0.05}), turn({0.3, 0.1, -1}), turn({5, 3, 1}))};
  ParticleSolver solver(model);
  for (int k = 0; k < 5000; ++k) solver.step();
  const Triple<double> p = position(solver, 0);
  return turned ? Triple<double>{p.y, p.z, p.x} : p;
}

}  // namespace

TEST_CASE("Permuting and rotating the boundary changes nothing beyond round-off") {
  const Triple<double> plain = end_on_net(false, false);
  REQUIRE(plain.z > 0);  // it has met wires: falling freely it would be at -0.012 m
  CHECK(length(end_on_net(true, false) - plain) < 1e-10);
  CHECK(length(end_on_net(false, true) - plain) < 1e-10);
}

TEST_CASE("The boundary's reactions add up to the opposite of the contact force and balance its moment") {
  const SphereCase c{.radius = 0.1, .youngs_modulus = 1e7, .restitution = 0.5, .friction = 0.4, .step = 1e-5};
  ParticleModel model = model_of(c, rigid());
  const std::array<Index, 1> material{1};
  model.boundary = Boundary(eight_triangles(), material);
  model.spheres = {c.sphere({0.3, 0.1, 0.0995}, {1, 0.5, -1})};
  ParticleSolver solver(model);
  solver.step();
  Triple<double> sum{}, moment{};
  for (Index i = 0; i < solver.boundary().node_count(); ++i) {
    const Triple<double> r = triple<double>(solver.boundary().reaction()[i]);
    sum = sum + r;
    moment = moment + cross(solver.boundary().position(i), r);
  }
  const Triple<double> f = force(solver, 0);
  REQUIRE(length(f) > 0);
  CHECK(length(sum + f) < 1e-12 * length(f));
  CHECK(length(moment + cross({0.3, 0.1, 0}, f)) < 1e-12 * length(f));
}
