// Slides that share what they run on: the explicit and the implicit way, which have nothing in common but the constraint.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "tests/unit/fem_solver/structural_scenes.hpp"

using namespace talus::fem;

namespace {

using talus::core::Vector3;

Vector3 moved(const std::string& structure, const std::string& method, const std::string& set, double end) {
  Structure built(tests::scene(structure + method));
  for (int k = 0; k < 20; ++k) built.integrator().advance(end / 20 * k, end / 20);
  const auto node = static_cast<std::size_t>(built.model().node_sets.at(set).front());
  return Vector3::Map(&built.integrator().displacement()[3 * node]);
}

/// Largest of the terms of the balance, and what is left of it.
std::pair<double, double> balance_of(const std::string& structure, const std::string& method, double end) {
  Structure built(tests::scene(structure + method));
  for (int k = 0; k < 20; ++k) built.integrator().advance(end / 20 * k, end / 20);
  const EnergyBalance b = built.integrator().balance();
  double sum = b.kinetic + b.slides - b.loads;
  for (const double joules : b.elastic) sum += joules;
  return {b.kinetic, sum};
}

const std::string cable = "cable: {area: 10 mm^2, density: 7850, youngs_modulus: 10 GPa, prestress: 20 MPa}";
const std::string explicitly = "  explicit: {}\n  step: 2 us\n",
                  implicitly = "  implicit: {spectral_radius: 0.8}\n  step: 20 us\n";

/// A rope, a second one that begins on it, and a bead on that one.
const std::string chain =
    "  parts:\n"
    "    carrier: {polyline: {points: [[0, 0, 0], [2, 0, 0]], divisions: 4}, " +
    cable +
    "}\n"
    "    crossing: {polyline: {points: [[0.62, 0, 0], [0.62, 1, 0]], divisions: 3}, " +
    cable +
    "}\n"
    "    thread: {polyline: {points: [[0.62, 0.4, 0], [0.9, 0.2, -1]]}, cable: {area: 0.1 mm^2, density: "
    "7850, "
    "youngs_modulus: 1 GPa}}\n"
    "  slides:\n"
    "    on_carrier: {rope: carrier, nodes: crossing.start, constraint: {}}\n"
    "    on_crossing: {rope: crossing, nodes: thread.start, constraint: {}}\n"
    "  point_masses: [{nodes: thread.start, mass: 0.5 kg}]\n"
    "  supports:\n"
    "    - {nodes: carrier.start, fix: xyz}\n"
    "    - {nodes: carrier.end, fix: xyz}\n"
    "    - {nodes: crossing.end, fix: xyz}\n"
    "    - {nodes: thread.end, fix: xyz}\n"
    "  loads: [{nodes: thread.start, force: [4 N, 3 N, -15 N]}]\n";

/// A square of cables that closes on itself, and a bead that runs past the corner where it begins.
const std::string ring =
    "  parts:\n"
    "    frame: {mesh: {nodes: [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], segments: [[0, 1], [1, 2], [2, "
    "3], [3, "
    "0]]}, " +
    cable +
    "}\n"
    "    bead: {polyline: {points: [[0, 0.02, 0], [0, 0.02, 3]]}, cable: {area: 0.1 mm^2, density: 10, "
    "youngs_modulus: 1 "
    "MPa}}\n"
    "  slides: {on_frame: {rope: frame, nodes: bead.start, constraint: {}}}\n"
    "  point_masses: [{nodes: bead.start, mass: 1 kg}]\n"
    "  supports: [{nodes: frame, fix: xyz}, {nodes: bead.end, fix: xyz}]\n"
    "  initial_velocities: [{nodes: bead.start, velocity: [0, -2 m/s, 0]}]\n"
    "  loads: [{nodes: bead.start, force: [100 N, 0, 0]}]\n";

}  // namespace

TEST_CASE("a bead on a rope that runs on another moves alike by impulses and by eliminated directions") {
  const double end = 0.02;
  const Vector3 by_impulses = moved(chain, explicitly, "thread.start", end),
                by_elimination = moved(chain, implicitly, "thread.start", end);
  CHECK(by_impulses.norm() > 2e-3);
  CHECK((by_impulses - by_elimination).norm() < 0.01 * by_impulses.norm());
  const Vector3 carried = moved(chain, explicitly, "crossing.start", end),
                eliminated = moved(chain, implicitly, "crossing.start", end);
  CHECK(carried.norm() > 1e-4);
  CHECK((carried - eliminated).norm() < 0.03 * carried.norm());
  const auto [kinetic, left] = balance_of(chain, explicitly, end);
  CHECK(std::abs(left) < 2e-4 * kinetic);
}

TEST_CASE("a bead runs round a closed rope past the node where it begins") {
  // Down the last side to the corner at (0, 0), then pulled along the first: 0.01 s down, the rest under 100 m/s^2.
  const double end = 0.05, left = end - 0.01;
  const Vector3 bead = moved(ring, explicitly, "bead.start", end);
  CHECK(bead.y() == Approx(-0.02).margin(1e-6));
  CHECK(bead.x() == Approx(0.5 * 100 * left * left).epsilon(0.02));  // the corner takes its speed down
}

TEST_CASE("a bead at rest on a closed rope is found past the node where it begins") {
  // Pulled to the corner at (1, 0) from the last side: the way leads over (0, 0), where the rope begins and ends.
  std::string still = ring;
  still.replace(still.find("force: [100 N, 0, 0]"), 20, "force: [90 N, -100 N, 0]");
  still.erase(still.find("  initial_velocities"), still.find("  loads") - still.find("  initial_velocities"));
  Structure built(tests::scene(still + "  static: {steps: 5}\n"));
  for (int k = 0; k < 5; ++k) built.integrator().advance(0.2 * k, 0.2);
  const auto node = static_cast<std::size_t>(built.model().node_sets.at("bead.start").front());
  const Vector3 bead = Vector3::Map(&built.integrator().displacement()[3 * node]);
  CHECK(bead.x() == Approx(1).margin(1e-9));
  CHECK(bead.y() == Approx(-0.02).margin(1e-9));
}

TEST_CASE("what a corner's gap costs as it is taken back stands in the ledger") {
  // A bead of 1 kg runs at 10 m/s over the corners of a stiff arc, pressed against it by a thread of 5 kN: each corner leaves
  // a gap of some 0.1 mm, which is taken back against the thread.
  std::string nodes, segments;
  for (int k = 0; k <= 8; ++k) {
    const double x = 0.5 * k;
    nodes += fmt::format("{}[{}, 0, {}]", k > 0 ? ", " : "", x, 0.1 * x * (4 - x));
    if (k < 8) segments += fmt::format("{}[{}, {}]", k > 0 ? ", " : "", k, k + 1);
  }
  const double start = 0.5 * 0.1 * 0.5 * 3.5;
  const std::string arc = fmt::format(
      "  parts:\n"
      "    arc: {{mesh: {{nodes: [{}], segments: [{}]}}, {}}}\n"
      "    thread: {{polyline: {{points: [[0.25, 0, {}], [2, 0, 10]]}}, cable: {{area: 10 mm^2, density: 10, "
      "youngs_modulus: "
      "1 MPa, prestress: 500 MPa}}}}\n"
      "  slides: {{on_arc: {{rope: arc, nodes: thread.start, constraint: {{}}}}}}\n"
      "  point_masses: [{{nodes: thread.start, mass: 1 kg}}]\n"
      "  supports: [{{nodes: arc, fix: xyz}}, {{nodes: thread.end, fix: xyz}}]\n"
      "  initial_velocities: [{{nodes: thread.start, velocity: [10 m/s, 0, {}]}}]\n",
      nodes, segments, cable, start, 10 * start / 0.25);
  Structure built(tests::scene(arc + "  explicit: {}\n  step: 0.1 ms\n"));
  Integrator& run = built.integrator();
  const auto total = [&] {
    const EnergyBalance b = run.balance();
    return b.kinetic + b.slides + b.elastic[0] + b.elastic[1];
  };
  const double before = total();
  double booked = 0, farthest = 0, worst = 0;
  for (int k = 0; k < 12; ++k) {
    run.free_velocity(0.01 * k, 1e-4);  // particles with implicit contact ask for it; asking costs nothing
    run.advance(0.01 * k, 0.01);
    booked = std::max(booked, std::abs(run.balance().slides));
    farthest = std::max(farthest, run.displacement()[3 * 9]);
    worst = std::max(worst, std::abs(total() - before));
  }
  CHECK(farthest > 2);  // over five corners at least
  CHECK(booked > 0.1);
  CHECK(worst < 1e-3);  // J, of 2200 J on the move
}
