#include "dem_solver/contact/implicit_velocities.hpp"

#include <catch2/catch.hpp>
#include <random>

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
            .spin = {},
            .node_velocity = {row({0, 0, 0}, 1 / node_mass)}};
  }
  Contact contact(double damping) const {
    return {.sphere = 0, .nodes = {0, -1, -1}, .weights = {1, 0, 0}, .normal = {0, 0, 1}, .damping = damping};
  }
  double inverse_mass() const { return 1 / ball_mass + 1 / node_mass; }
};

/// Contacts of one sphere with random features among a few nodes.
struct RandomSystem {
  std::vector<Contact> contacts;
  Bodies bodies;

  explicit RandomSystem(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1), both(-1, 1);
    bodies.velocity = {row({both(random), both(random), -5 * unit(random)}, 1 / 80.0)};
    bodies.spin = {row({both(random), both(random), both(random)}, 1 / 1.3)};
    for (int k = 0; k < 5; ++k)
      bodies.node_velocity.push_back(row({both(random), both(random), both(random)}, 1 / 0.03));
    for (Index k = 0; k < 4; ++k) {
      const double along = unit(random);
      const Triple<double> n{0.3 * both(random), 0.3 * both(random), 1};
      contacts.push_back({.sphere = 0,
                          .nodes = {k, k + 1, -1},
                          .weights = {1 - along, along, 0},
                          .normal = (1 / length(n)) * n,
                          .arm = 0.2,
                          .elastic = 200 * unit(random),
                          .damping = 3000 * unit(random),
                          .tangential_stiffness = 1e4,
                          .tangential_damping = 2000 * unit(random),
                          .coefficient = 0.6});
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
    RandomSystem system(seed);
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
    RandomSystem system(seed);
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
  RandomSystem system(7);
  const Bodies start = system.bodies;
  ImplicitVelocities::solve(system.contacts, system.bodies, 50e-6, exact);
  Bodies again = start;
  CHECK(ImplicitVelocities::solve(system.contacts, again, 50e-6, {.tolerance = 1e-9, .most_sweeps = 10}) ==
        1);
}

}  // namespace
}  // namespace talus::dem
