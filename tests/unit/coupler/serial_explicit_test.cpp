#include "coupler/schemes/serial_explicit.hpp"

#include <catch2/catch.hpp>

#include "coupler/session/introduction.hpp"
#include "tests/support/in_process.hpp"
#include "tests/support/two_masses.hpp"

using namespace talus;

namespace {

constexpr coupler::Window window_of(std::int64_t index) {
  return {.index = index, .unit = 1e-3};
}
constexpr int windows = 2000;  // 2 s: several contacts and rebounds

struct Histories {
  std::vector<double> particle, structure;
};

/// Two masses and two springs in one leapfrog: the reference.
Histories undivided(const test::TwoMasses& system) {
  Histories history;
  test::Mass node{.mass = system.structure_mass};
  test::Mass particle{
      .mass = system.particle_mass, .position = system.gap, .velocity = system.particle_velocity};
  for (int n = 0; n < windows; ++n) {
    const double push = test::contact_force(system, particle.position, node.position);
    particle.advance(push, window_of(n).length());
    node.advance(-push - system.structure_stiffness * node.position, window_of(n).length());
    history.particle.push_back(particle.position);
    history.structure.push_back(node.position);
  }
  return history;
}

struct Outcome {
  Histories history;
  double work_on_structure = 0, work_on_boundary = 0;
};

Outcome divided(const test::TwoMasses& system) {
  Outcome outcome;
  const auto segment = coupler::transport::create_heap_segment();
  coupler::Session session(segment, {});
  session.await(coupler::Role::structure);
  session.await(coupler::Role::particles);
  const test::ParticipantThread structure(segment, coupler::Role::structure, [&](auto& participant) {
    test::serve_structure(participant, system);
  });
  const test::ParticipantThread particles(segment, coupler::Role::particles, [&](auto& participant) {
    test::serve_particles(participant, system, &outcome.history.particle);
  });
  session.wait_joined();
  const auto interface = coupler::introduce(session, coupler::identical_surfaces());
  coupler::lay_out_arrays(session, interface, {window_of(0).length()});
  coupler::Exchange exchange(session, interface->tie.mapping);
  for (int n = 0; n < windows; ++n) {
    coupler::SerialExplicit{}.compute(exchange, window_of(n));
    const auto* node = session.find(coupler::Role::structure);
    outcome.history.structure.push_back(node->array(coupler::transport::ArrayName::displacement)[2]);
  }
  session.ask_all({.action = coupler::Action::report});  // the particles meet the last motion
  outcome.work_on_structure = exchange.work_on_structure();
  outcome.work_on_boundary = exchange.work_on_boundary();
  session.finish();
  return outcome;
}

}  // namespace

TEST_CASE(
    "two masses and a spring, split between two participants, move as the undivided system to the last bit") {
  const test::TwoMasses system;
  const Histories expected = undivided(system);
  const Histories got = divided(system).history;
  CHECK(got.particle == expected.particle);
  CHECK(got.structure == expected.structure);
}

TEST_CASE("the interface of identical surfaces and equal steps loses no work") {
  const Outcome outcome = divided({});
  const double impact_energy = 0.5 * 5 * 3 * 3;
  CHECK(std::abs(outcome.work_on_structure) > 0.01 * impact_energy);
  // Both works sum the same products; only their order could differ.
  CHECK(outcome.work_on_structure == Approx(outcome.work_on_boundary).epsilon(1e-12));
}
