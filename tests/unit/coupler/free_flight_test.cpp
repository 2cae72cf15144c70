#include "coupler/schemes/free_flight.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "coupler/schemes/serial_explicit.hpp"
#include "tests/support/coupled_pair.hpp"
#include "tests/support/two_masses.hpp"

using namespace talus;
using namespace talus::coupler;

namespace {

/// s; a power of two, so that a window cut into steps has steps of exactly this length
constexpr double step = 1.0 / 1024;
constexpr std::int64_t regular_windows = 2048;

int steps_of(const Command& command) {
  return static_cast<int>(std::lround(command.length / step));
}

/// The two masses of two_masses.hpp, each in steps of its own.
void serve_node(Participant& participant, const test::TwoMasses& system) {
  participant.publish_surface(test::one_node(), std::array{system.structure_mass});
  participant.declare({.program = "spring", .step = step});
  test::Mass node{.mass = system.structure_mass}, saved = node;
  for (auto command = participant.next(); command.action != Action::finish; command = participant.next()) {
    const auto fields = participant.structure_fields();
    if (command.action == Action::save_state) saved = node;
    if (command.action == Action::restore_state) node = saved;
    if (command.action == Action::advance)
      for (int k = 0; k < steps_of(command); ++k)
        node.advance(fields.force[2] - system.structure_stiffness * node.position, step);
    fields.displacement[2] = node.position;
    fields.velocity[2] = node.velocity;
    participant.answer();
  }
}

struct Seen {
  std::vector<double> particle;  ///< m; at the end of each step that was not taken back
  std::int64_t windows = 0;      ///< computed, taken back or not
};

void serve_particle(Participant& participant, const test::TwoMasses& system, Seen& seen) {
  std::vector<double> masses;
  participant.receive_surface(masses);
  participant.declare({.program = "mass", .step = step});
  test::Mass particle{
      .mass = system.particle_mass, .position = system.gap, .velocity = system.particle_velocity};
  test::Mass saved = particle;
  std::size_t saved_steps = 0;
  for (auto command = participant.next(); command.action != Action::finish; command = participant.next()) {
    const auto fields = participant.particle_fields();
    if (command.action == Action::save_state) {
      saved = particle;
      saved_steps = seen.particle.size();
    }
    if (command.action == Action::restore_state) {
      particle = saved;
      seen.particle.resize(saved_steps);
    }
    if (command.action == Action::advance) {
      ++seen.windows;
      const int steps = steps_of(command);
      fields.force[2] = 0;
      for (int k = 0; k < steps; ++k) {
        const double u = fields.start_displacement[2], end = fields.end_displacement[2];
        const double push =
            test::contact_force(system, particle.position, u + (end - u) * static_cast<double>(k) / steps);
        particle.advance(push, step);
        fields.force[2] -= push / steps;
        seen.particle.push_back(particle.position);
      }
    }
    participant.answer();
  }
}

struct Divided {
  Seen seen;
  FlightTally tally;
  double peak = 0, work_on_structure = 0, work_on_boundary = 0;
};

Divided divided(const test::TwoMasses& system, std::int64_t longest) {
  Divided result;
  test::CoupledPair pair([&](auto& p) { serve_node(p, system); },
                         [&](auto& p) { serve_particle(p, system, result.seen); },
                         {.regular = step, .longest = static_cast<double>(longest) * step});
  FreeFlight flight(pair.exchange(), longest);
  SerialExplicit scheme;
  for (std::int64_t n = 0; n < regular_windows;) {
    const Window window{.index = n, .unit = step};
    std::int64_t gone = longest > 1 ? flight.compute(window, regular_windows - n) : 0;
    if (gone == 0) {
      scheme.compute(pair.exchange(), window);
      gone = 1;
    }
    n += gone;
    result.peak = std::max(result.peak, -pair.displacement());
  }
  pair.session().ask_all({.action = Action::report});  // the particles meet the last motion
  result.tally = flight.tally();
  result.work_on_structure = pair.exchange().work_on_structure();
  result.work_on_boundary = pair.exchange().work_on_boundary();
  return result;
}

/// Both masses in one leapfrog.
struct OnePieceRun {
  std::vector<double> particle;
  double peak = 0;
};
OnePieceRun in_one_piece(const test::TwoMasses& system) {
  OnePieceRun result;
  test::Mass node{.mass = system.structure_mass};
  test::Mass particle{
      .mass = system.particle_mass, .position = system.gap, .velocity = system.particle_velocity};
  for (std::int64_t n = 0; n < regular_windows; ++n) {
    const double push = test::contact_force(system, particle.position, node.position);
    particle.advance(push, step);
    node.advance(-push - system.structure_stiffness * node.position, step);
    result.particle.push_back(particle.position);
    result.peak = std::max(result.peak, -node.position);
  }
  return result;
}

/// A long fall, one impact, and a long way out.
constexpr test::TwoMasses far_away{.structure_stiffness = 3000, .contact_stiffness = 7000, .gap = 1.5};

}  // namespace

TEST_CASE("windows that grow in free flight find the first touch in the step where it is") {
  const OnePieceRun expected = in_one_piece(far_away);
  const Divided grown = divided(far_away, 64);
  CHECK(grown.seen.particle.size() == static_cast<std::size_t>(regular_windows));
  // Up to the impact nothing moves but the particle, in the same steps: the same bits, and so is the impact.
  const auto impact = static_cast<std::size_t>(far_away.gap / (-far_away.particle_velocity * step)) + 40;
  CHECK(std::equal(expected.particle.begin(), expected.particle.begin() + static_cast<std::ptrdiff_t>(impact),
                   grown.seen.particle.begin()));
  CHECK(grown.peak == Approx(expected.peak).epsilon(1e-12));
  CHECK(grown.tally.longest == 64);
  CHECK(grown.seen.windows < regular_windows / 4);
  CHECK(grown.tally.taken_back > 0);
}

TEST_CASE("windows that grow leave the works of both sides as they are") {
  const Divided grown = divided(far_away, 64), regular = divided(far_away, 1);
  CHECK(regular.seen.windows == regular_windows);
  CHECK(std::abs(regular.work_on_structure) > 1);  // J, of 6.75 that the particle brings
  CHECK(grown.work_on_structure == Approx(regular.work_on_structure).epsilon(1e-12));
  CHECK(grown.work_on_boundary == Approx(grown.work_on_structure).epsilon(1e-12));
}
