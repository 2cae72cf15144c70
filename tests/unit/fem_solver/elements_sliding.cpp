#include <catch2/catch.hpp>

#include "fem_solver/elements/axial.hpp"
#include "tests/support/finite_differences.hpp"
#include "tests/unit/fem_solver/ropes.hpp"

using namespace talus;
using namespace talus::fem;
using namespace talus::test;

namespace {

constexpr double gap = 0.01;
const AxialSection steel{1e-4, 1e9, 1e6};
const double stiffness_scale = steel.area * steel.youngs_modulus;  // E A, N

/// A rope whose unstretched length is `slack` times what it spans.
SlidingCable rope_of(const Eigen::VectorXd& x, double slack) {
  return {RopeLaw(steel), slack * total(segment_lengths(x)), gap};
}

Eigen::MatrixXd sliding_stiffness(const SlidingCable& rope, const Eigen::VectorXd& x) {
  return nodal_stiffness(x.size(), [&](const auto& sink) { rope.stiffness(chords_of(x), sink); });
}

}  // namespace

TEST_CASE("the tension of a rope is the derivative of its energy") {
  const RopeLaw law(steel);
  for (const double q : {0.9, 0.9985, 1.0, 1.01, 1.3}) {
    const auto energy = [&](const Eigen::VectorXd& x) { return as_vector(law.energy_per_length(x[0])); };
    const auto tension = [&](const Eigen::VectorXd& x) { return as_vector(law.tension(x[0])); };
    CHECK(central_differences(energy, as_vector(q), 1e-6)(0, 0) ==
          Approx(law.tension(q)).margin(1e-8 * stiffness_scale));
    CHECK(central_differences(tension, as_vector(q), 1e-6)(0, 0) ==
          Approx(law.tension_slope(q)).margin(1e-8 * stiffness_scale));
  }
  CHECK(law.slack_stretch() == Approx(std::sqrt(1 - 2 * 1e6 / 1e9)));
  CHECK(law.tension(0.999 * law.slack_stretch()) == 0);
}

TEST_CASE("a segment is as smooth at its gap as anywhere") {
  Dice dice(31);
  for (const double r : {0.0, 0.3 * gap, 0.999999 * gap, 1.000001 * gap, 3 * gap}) {
    const core::Vector3 chord = dice.rotation().col(0) * r;
    const RopeSegment segment(chord, gap);
    const auto length = [](const Eigen::VectorXd& d) {
      return as_vector(RopeSegment(core::Vector3(d), gap).length);
    };
    const auto direction = [](const Eigen::VectorXd& d) {
      return Eigen::VectorXd(RopeSegment(core::Vector3(d), gap).direction);
    };
    // steps of 1e-9 m: round-off of g over the step 1e-9, curvature 1/g times the step 1e-7
    CHECK((central_differences(length, chord, 1e-9).transpose() - segment.direction).norm() < 1e-6);
    CHECK((central_differences(direction, chord, 1e-9) - segment.curvature()).norm() * gap < 1e-6);
    const core::Vector3 change = dice.vector(1);
    CHECK((segment.curvature() * change - segment.curvature_product(change)).norm() * gap < 1e-14);
  }
}

TEST_CASE(
    "the force of a sliding cable is the derivative of its energy and its stiffness that of its force") {
  Dice dice(32);
  for (int trial = 0; trial < 40; ++trial) {
    const Eigen::VectorXd x = winding_rope(dice, 2 + trial % 6);
    const SlidingCable rope = rope_of(x, dice.uniform(0.8, 0.99));
    const Eigen::VectorXd f = sliding_force(rope, x);
    const Eigen::MatrixXd K = sliding_stiffness(rope, x);
    const auto energy = [&](const Eigen::VectorXd& y) { return as_vector(rope.energy(chords_of(y))); };
    const auto force = [&](const Eigen::VectorXd& y) { return sliding_force(rope, y); };
    // steps of 1e-5 m on metres: step^2 = 1e-10, round-off over step 1e-11
    CHECK((central_differences(energy, x, 1e-5).transpose() - f).norm() < 1e-8 * stiffness_scale);
    CHECK((central_differences(force, x, 1e-5) - K).norm() < 1e-7 * stiffness_scale);
    const Eigen::VectorXd w = Eigen::VectorXd::Random(x.size());
    const Eigen::VectorXd product = nodal_forces(
        x.size(), [&](const auto& sink) { rope.stiffness_product(chords_of(x), chords_of(w), sink); });
    CHECK((product - K * w).norm() < 1e-12 * stiffness_scale * w.norm());
  }
}

TEST_CASE("a sliding cable of one segment is the plain cable") {
  Dice dice(33);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd X = winding_rope(dice, 2), x = X + 0.1 * Eigen::VectorXd::Random(6);
    const SlidingCable rope = rope_of(X, 1);
    const core::Vector3 D = X.tail<3>() - X.head<3>(), w = x.tail<3>() - x.head<3>() - D;
    const AxialElement<TensionOnly> cable{D, 1 / D.norm(), steel};
    constexpr double round_off = 1e-14;  // of a strain, both being differences of lengths squared
    CHECK((sliding_force(rope, x).tail<3>() - cable.force(w)).norm() < round_off * stiffness_scale * 10);
    CHECK(std::abs(rope.energy(chords_of(x)) - cable.energy(w)) < round_off * stiffness_scale * 10);
  }
}

TEST_CASE("all segments of a sliding cable carry the tension of its whole length [P eq. 3, 4]") {
  Dice dice(34);
  const Eigen::VectorXd x = winding_rope(dice, 6);
  const SlidingCable rope = rope_of(x, 0.97);
  const double l = total(segment_lengths(x)), L = rope.reference_length, e = (l * l - L * L) / (2 * L * L);
  const double N = steel.area * (steel.youngs_modulus * e + steel.prestress) * l / L;
  rope.segment_forces(chords_of(x), [&](std::size_t, const core::Vector3& force) {
    CHECK(force.norm() == Approx(N).epsilon(1e-12));
  });
  const Eigen::VectorXd f = sliding_force(rope, x);
  const core::Vector3 T3 =
      (x.segment<3>(6) - x.segment<3>(3)).normalized() - (x.segment<3>(9) - x.segment<3>(6)).normalized();
  CHECK((f.segment<3>(6) - N * T3).norm() < 1e-12 * N);
}

TEST_CASE("a straight sliding cable leaves its inner nodes alone, wherever they sit") {
  Eigen::VectorXd x(12);
  x << 0, 0, 0, 0.1, 0.2, 0.05, 3, 6, 1.5, 4, 8, 2;
  const Eigen::VectorXd f = sliding_force(rope_of(x, 0.95), x);
  CHECK(f.segment<6>(3).norm() < 1e-15 * stiffness_scale);
  CHECK(f.head<3>().norm() > 1e-3 * stiffness_scale);
}

TEST_CASE("a slack sliding cable has no force and no stiffness") {
  Dice dice(35);
  const Eigen::VectorXd x = winding_rope(dice, 5);
  const SlidingCable rope = rope_of(x, 1.1);
  CHECK(sliding_force(rope, x).norm() == 0);
  CHECK(sliding_stiffness(rope, x).norm() == 0);
}

TEST_CASE("reversing the nodes of a sliding cable reverses its forces to round-off") {
  Dice dice(36);
  const Eigen::VectorXd x = winding_rope(dice, 7);
  const SlidingCable rope = rope_of(x, 0.9);
  CHECK((reversed(sliding_force(rope, reversed(x))) - sliding_force(rope, x)).norm() <
        1e-14 * stiffness_scale);
}

TEST_CASE("turning a sliding cable turns its force") {
  Dice dice(37);
  const Eigen::VectorXd x = winding_rope(dice, 5);
  const SlidingCable rope = rope_of(x, 0.9);
  const Eigen::Matrix3d R = dice.rotation();
  CHECK((sliding_force(rope, turned(R, x)) - turned(R, sliding_force(rope, x))).norm() <
        1e-13 * stiffness_scale);
}

TEST_CASE("a slider that reaches the end of its rope, or its neighbour, stays finite and conservative") {
  Eigen::VectorXd x(12);
  x << 0, 0, 0, 1, 0.4, 0, 2, 0.4, 0, 3, 0, 0;
  const SlidingCable rope = rope_of(x, 0.95);
  // Node 1 travels onto the first end and node 2 onto node 1, through coincidence; the energy's change is the
  // work of the force.
  const auto path = [&](double s) {
    Eigen::VectorXd y = x;
    y.segment<3>(3) = core::Vector3(0, 0, 0) + (1 - s) * core::Vector3(1, 0.4, 0);
    y.segment<3>(6) = core::Vector3(0, 0, 0) + (1 - s) * core::Vector3(2, 0.4, 0);
    return y;
  };
  double done = 0;
  constexpr int parts = 40000;
  for (int k = 0; k < parts; ++k) {
    const double s = 1.2 * k / parts, next = 1.2 * (k + 1) / parts;  // past the end by 0.2
    const Eigen::VectorXd f = sliding_force(rope, path(0.5 * (s + next)));
    REQUIRE(f.allFinite());
    done += f.dot(path(next) - path(s));
  }
  const double change = rope.energy(chords_of(path(1.2))) - rope.energy(chords_of(x));
  CHECK(done == Approx(change).margin(1e-5 * stiffness_scale));  // midpoint rule over the gap's kink
  REQUIRE(sliding_stiffness(rope, path(1.0)).allFinite());
}

TEST_CASE("a slider pushed against the end of its rope by less than the tension stops within the gap") {
  // Rope from (0,0,0) to (3,0,0), one slider, pushed towards the first end by half the tension: the smooth
  // tip holds it where N (t_1 - t_2) balances the push. Straight rope: N (r/g - 1) + ... = -P, so r = g (1 -
  // P/N).
  Eigen::VectorXd x(9);
  x << 0, 0, 0, 0.5 * gap, 0, 0, 3, 0, 0;
  const SlidingCable rope{RopeLaw(steel), 2.9, gap};
  const double N = rope.tension(chords_of(x)), P = 0.5 * N;
  const Eigen::VectorXd f = sliding_force(rope, x);
  CHECK(f[3] == Approx(-P).epsilon(1e-12));  // internal force: the push that holds the slider there
  // A move of the slider along the rope turns the tip, N/g, and changes the length by r/g - 1 = -1/2 of itself,
  // which is (r^2/g + g)/2 + 3 - r here: q of it over 2.9 m, N = A (E (q^2 - 1)/2 + S) q.
  const double q = (0.625 * gap + 3 - 0.5 * gap) / 2.9;
  const double slope = steel.area * (0.5 * steel.youngs_modulus * (3 * q * q - 1) + steel.prestress);
  CHECK(sliding_stiffness(rope, x)(3, 3) == Approx(N / gap + 0.25 * slope / 2.9).epsilon(1e-12));
}
