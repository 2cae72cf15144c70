#include "dem_solver/contact/implicit_velocities.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "tests/verification/particles/particle_models.hpp"

namespace talus::dem {
namespace {

using Contact = ImplicitVelocities::Contact;
using Bodies = ImplicitVelocities::Bodies;

constexpr ImplicitVelocities::Control exact{.tolerance = 1e-13, .most_sweeps = 100000};

/// A ball of 100 kg falls onto one free node of 0.03 kg.
struct OneNode {
  double ball_mass = 100, node_mass = 0.03, approach = 8;  // kg, kg, m/s
  Bodies bodies() const {
    return {.velocity = {row({0, 0, -approach}, 1 / ball_mass)},
            .spin = {{}},
            .inverse_inertia = {{}},
            .node_velocity = {row({0, 0, 0}, 1 / node_mass)}};
  }
  Contact contact(double damping) const {
    return {.body = 0, .nodes = {0, -1, -1}, .weights = {1, 0, 0}, .normal = {0, 0, 1}, .damping = damping};
  }
  double inverse_mass() const { return 1 / ball_mass + 1 / node_mass; }
};

/// Of a sphere, and of a long rock whose axes lie across those of space: tensor of moments 0.3, 1.2, 1.3.
const ImplicitVelocities::InverseInertia round{{1 / 1.3, 0, 0}, {0, 1 / 1.3, 0}, {0, 0, 1 / 1.3}},
    elongated{{(1 / 0.3 + 1 / 1.2) / 2, (1 / 0.3 - 1 / 1.2) / 2, 0},
              {(1 / 0.3 - 1 / 1.2) / 2, (1 / 0.3 + 1 / 1.2) / 2, 0},
              {0, 0, 1 / 1.3}};

/// Contacts of one body with random features among a few nodes.
struct RandomSystem {
  std::vector<Contact> contacts;
  Bodies bodies;

  RandomSystem(unsigned seed, const ImplicitVelocities::InverseInertia& inverse_inertia) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1), both(-1, 1);
    bodies.velocity = {row({both(random), both(random), -5 * unit(random)}, 1 / 80.0)};
    bodies.spin = {{both(random), both(random), both(random)}};
    bodies.inverse_inertia = {inverse_inertia};
    for (int k = 0; k < 5; ++k)
      bodies.node_velocity.push_back(row({both(random), both(random), both(random)}, 1 / 0.03));
    for (Index k = 0; k < 4; ++k) {
      const double along = unit(random);
      const Triple<double> n{0.3 * both(random), 0.3 * both(random), 1};
      contacts.push_back({.body = 0,
                          .nodes = {k, k + 1, -1},
                          .weights = {1 - along, along, 0},
                          .normal = (1 / length(n)) * n,
                          .lever = {0.3 * both(random), 0.3 * both(random), -0.2},
                          .elastic = 200 * unit(random),
                          .damping = 3000 * unit(random),
                          .tangential_stiffness = 1e4,
                          .tangential_damping = 2000 * unit(random),
                          .coefficient = 0.6});
      if (k % 2 == 0) continue;
      // Limited by a saddle: at the node that both features share, and a third one.
      Contact& limited = contacts.back();
      const Triple<double> s{0.2 * both(random), 0.2 * both(random), 1};
      limited.saddle_normal = (1 / length(s)) * s;
      limited.saddle_lever = {0.3 * both(random), 0.3 * both(random), -0.2};
      limited.saddle_nodes = {k + 1, k - 1, -1};
      limited.saddle_weights = {0.7, 0.3, 0};
    }
  }
};

double law_normal(const Contact& c, const Triple<double>& u) {
  return std::max(0.0, c.elastic - c.damping * dot(u, c.normal));
}

Triple<double> law_tangential(const Contact& c, const Triple<double>& u, double step) {
  const Triple<double> ut = u - dot(u, c.normal) * c.normal;
  Triple<double> t = c.spring - (c.tangential_stiffness * step + c.tangential_damping) * ut;
  const double limit = c.coefficient * law_normal(c, u);
  return length(t) > limit ? (limit / length(t)) * t : t;
}

TEST_CASE("A dashpot far above the light node's limit stops the approach and never reverses it") {
  const OneNode scene;
  const double step = 50e-6;
  for (const double damping : {10.0, 1e3, 1e5, 1e9}) {
    Bodies bodies = scene.bodies();
    std::vector<Contact> contacts{scene.contact(damping)};
    ImplicitVelocities::solve(contacts, bodies, step, exact);
    const double after = ImplicitVelocities::relative_velocity(contacts[0], bodies).z;
    // u = u0 - dt g c u, solved for u
    const double expected = -scene.approach / (1 + damping * step * scene.inverse_mass());
    // Round-off of the 8 m/s that cancel.
    CHECK(after == Approx(expected).epsilon(1e-12).margin(1e-14));
    CHECK(after <= 0);
  }
}

TEST_CASE("For a vanishing step the implicit force is the explicit one") {
  const OneNode scene;
  const double damping = 2e4, step = 1e-12;
  Bodies bodies = scene.bodies();
  std::vector<Contact> contacts{scene.contact(damping)};
  ImplicitVelocities::solve(contacts, bodies, step, exact);
  // They differ by c dt g, here 7e-7.
  CHECK(contacts[0].force.z == Approx(damping * scene.approach).epsilon(1e-6));
}

TEST_CASE("Forces and end velocities of contacts that share nodes obey the contact law together") {
  const double step = 50e-6;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    RandomSystem system(seed, seed % 2 == 0 ? round : elongated);
    const int sweeps = ImplicitVelocities::solve(system.contacts, system.bodies, step, exact);
    REQUIRE(sweeps <= exact.most_sweeps);
    double largest = 0;
    for (const Contact& c : system.contacts) largest = std::max(largest, length(c.force));
    for (const Contact& c : system.contacts) {
      const Triple<double> u = ImplicitVelocities::relative_velocity(c, system.bodies);
      const Triple<double> law = law_normal(c, u) * c.normal + law_tangential(c, u, step);
      CHECK(length(law - c.force) <= 1e-8 * largest);  // round-off of 1e5 dashpot times velocity
      CHECK(dot(c.force, c.normal) >= 0);
    }
  }
}

TEST_CASE("Implicit contact moves momentum between sphere and nodes but makes none") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    RandomSystem system(seed, seed % 2 == 0 ? round : elongated);
    const auto momentum = [&] {
      Triple<double> sum{};
      for (const auto* rows : {&system.bodies.velocity, &system.bodies.node_velocity})
        for (const Row& body : *rows) sum = sum + (1 / body.w) * triple<double>(body);
      return sum;
    };
    const Triple<double> before = momentum();
    ImplicitVelocities::solve(system.contacts, system.bodies, 50e-6, exact);
    CHECK(length(momentum() - before) <= 1e-12 * length(before));
  }
}

TEST_CASE("A start from the right forces needs one sweep") {
  RandomSystem system(7, elongated);
  const Bodies start = system.bodies;
  ImplicitVelocities::solve(system.contacts, system.bodies, 50e-6, exact);
  Bodies again = start;
  CHECK(ImplicitVelocities::solve(system.contacts, again, 50e-6, {.tolerance = 1e-9, .most_sweeps = 10}) ==
        1);
}

/// A ball of 65 kg falls onto a wire that is held at its ends by light nodes, which its dashpot overwhelms.
ParticleModel ball_above_a_wire() {
  const cases::SphereCase c{.radius = 0.2,
                            .density = 2000,
                            .youngs_modulus = 1e7,
                            .restitution = 0.2,
                            .friction = 0.4,
                            .step = 5e-5};
  ParticleModel model = cases::model_of(c, cases::rigid());
  mesh::Surface wire;
  wire.positions = {-1, 0, 0, 1, 0.1, 0};
  wire.segments = {{0, 1}};
  wire.parts = {{.name = "wire", .segment_end = 1}};
  model.boundary = Boundary(wire, std::array<Index, 1>{1});
  model.boundary.set_node_masses(std::array{0.05, 0.05}, 0);
  model.spheres = {c.sphere({0.1, 0.05, 0.2}, {0.5, 0.2, -3}, {1, 2, 3})};
  model.implicit_contact = exact;
  return model;
}

ParticleSolver after_impact(ParticleModel model) {
  model.boundary.set_free_velocity(std::vector<double>(6, 0.0), 0);
  ParticleSolver solver(std::move(model));
  for (int n = 0; n < 400; ++n) solver.step();
  return solver;
}

TEST_CASE("A rock of one sphere meets light nodes like the sphere") {
  const ParticleModel alone = ball_above_a_wire();
  ParticleModel as_rock = alone;
  SphereInput& ball = as_rock.spheres[0];
  const double inertia = 0.4 * ball.mass * ball.radius * ball.radius;
  as_rock.rocks = {{.mass = ball.mass,
                    .moments = {inertia, inertia, inertia},
                    .centre = ball.position,
                    .velocity = ball.velocity,
                    .spin = ball.spin}};
  ball.rock = 0;
  const ParticleSolver sphere = after_impact(alone), rock = after_impact(as_rock);
  REQUIRE(cases::velocity(sphere, 0).z > -2.9);
  REQUIRE(std::abs(cases::spin(sphere, 0).y - 2) > 0.01);
  // The rock's spin is found from its momentum by rotations: round-off of 400 steps.
  CHECK(length(cases::position(rock, 0) - cases::position(sphere, 0)) < 1e-10);
  CHECK(length(cases::velocity(rock, 0) - cases::velocity(sphere, 0)) < 1e-9);
  CHECK(length(cases::spin(rock, 0) - cases::spin(sphere, 0)) < 1e-8);
}

}  // namespace
}  // namespace talus::dem
