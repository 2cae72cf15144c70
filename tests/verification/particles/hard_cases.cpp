#include <catch2/catch.hpp>

#include <algorithm>

#include "core/scene/reader.hpp"
#include "core/scene/sections.hpp"
#include "dem_solver/scene/build_model.hpp"
#include "tests/verification/particles/particle_models.hpp"

using namespace talus;
using namespace talus::dem;
using namespace talus::dem::cases;

namespace {

struct HardCase {
  ParticleModel model;
  double end = 0;  ///< s
};

/// A scene of configs/hard/, which says what must hold and why it is hard.
HardCase hard_case(const std::string& name) {
  const auto file = core::SceneFile::load(std::string(TALUS_SOURCE_DIR) + "/configs/hard/" + name + ".yaml");
  core::SceneReader reader(file);
  const auto time = reader.required<core::TimeScene>("time");
  const auto particles = reader.required<ParticlesScene>("particles");
  reader.optional<core::OutputScene>("output");
  reader.finish();
  return {build_model(particles, make_surface(particles.boundaries), {.step = *time.step, .ledger = true}),
          time.end};
}

std::int64_t steps_of(const HardCase& c) {
  return std::llround(c.end / c.model.step);
}

}  // namespace

TEST_CASE("Restitution 1 with friction makes no energy in a million steps", "[long]") {
  const HardCase c = hard_case("endless_bounce");
  REQUIRE(steps_of(c) == 1'000'000);
  ParticleSolver solver(c.model);
  const double start = solver.ledger().balance();
  double highest = start, drift = 0;
  int bounces = 0;
  for (double last = 1; solver.steps_done() < 1'000'000; last = velocity(solver, 0).z) {
    solver.step();
    bounces += last < 0 && velocity(solver, 0).z > 0;
    if (solver.steps_done() % 100 != 0) continue;
    const ParticleLedger l = solver.ledger();
    highest = std::max(highest, l.kinetic + l.rotation + l.elastic - l.gravity);
    drift = std::max(drift, std::abs(l.balance() - start));
  }
  REQUIRE(bounces > 100);
  // The leapfrog's energy is off by (pi step/t_c)^2/6 while a contact of 50 steps lasts, and comes back.
  constexpr double within_a_contact = 1e-3;
  CHECK(highest < (1 + within_a_contact) * start);
  CHECK(drift < within_a_contact * start);
}

TEST_CASE("Fast small stones stay in front of a net of thin wires") {
  const HardCase c = hard_case("fast_small_stone");
  ParticleSolver solver(c.model);
  std::vector<double> lowest(c.model.spheres.size(), 1);
  for (std::int64_t n = 0; n < steps_of(c); ++n) {
    solver.step();
    for (Index id = 0; id < solver.spheres().size(); ++id)
      lowest[id] = std::min(lowest[id], position(solver, id).z);
  }
  for (Index id = 0; id < solver.spheres().size(); ++id) {
    INFO("stone " << id);
    CHECK(lowest[id] > 0);
    CHECK(velocity(solver, id).z > 0);
    CHECK(length(velocity(solver, id)) < 40.01);
  }
}

TEST_CASE("A sphere that rolls over edges and vertices moves as on the plane") {
  const HardCase c = hard_case("rolling_over_edges");
  ParticleModel plane = c.model;
  plane.boundary = {};
  plane.planes = {floor()};
  ParticleSolver on_triangles(c.model), on_plane(plane);
  for (std::int64_t n = 0; n < steps_of(c); ++n) {
    on_triangles.step();
    on_plane.step();
  }
  const double radius = c.model.spheres[0].radius;
  REQUIRE(position(on_plane, 0).x > 0.1);  // it has crossed the middle
  CHECK(length(position(on_triangles, 0) - position(on_plane, 0)) < 1e-6 * radius);
  CHECK(radius * length(spin(on_triangles, 0) - spin(on_plane, 0)) < 1e-6);
}

TEST_CASE("A problem in millimetres, tonnes and seconds has the path it has in SI") {
  const HardCase c = hard_case("other_units");
  constexpr double metre = 1e3, kilogram = 1e-3, pascal = 1e-6;  // in mm, t, MPa
  ParticleModel si = c.model;
  si.gravity = (1 / metre) * c.model.gravity;
  for (SphereInput& s : si.spheres) {
    s.position = (1 / metre) * s.position;
    s.velocity = (1 / metre) * s.velocity;
    s.radius /= metre;
    s.mass /= kilogram;
  }
  for (Index a = 0; a < c.model.pairs.materials(); ++a)
    for (Index b = 0; b <= a; ++b) {
      PairParameters p = c.model.pairs(a, b);
      p.normal.x /= pascal;
      p.normal.y /= pascal;
      si.pairs.set(a, b, p);
    }
  ParticleSolver in_mm(c.model), in_m(si);
  for (std::int64_t n = 0; n < steps_of(c); ++n) {
    in_mm.step();
    in_m.step();
  }
  REQUIRE(velocity(in_m, 1).x > -0.4);  // the spheres have met
  for (Index id = 0; id < 2; ++id)
    CHECK(length((1 / metre) * position(in_mm, id) - position(in_m, id)) < 1e-9 * si.spheres[id].radius);
}
