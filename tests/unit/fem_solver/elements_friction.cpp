#include <catch2/catch.hpp>

#include "tests/support/finite_differences.hpp"
#include "tests/unit/fem_solver/ropes.hpp"

using namespace talus;
using namespace talus::fem;
using namespace talus::test;

namespace {

const AxialSection stiff_steel{1e-4, 1e11, 0};
/// Slip below this share of the rope is round-off of sums of lengths.
constexpr double no_slip = 1e-13;
const double stiff_scale = stiff_steel.area * stiff_steel.youngs_modulus;

/// A frictional rope with its history, stepped by hand.
struct TestRope {
  FrictionalCable cable;
  std::vector<double> material, settled;
  double dissipated = 0;

  TestRope(double friction, const Eigen::VectorXd& x, double slack = 1, double slider = 1e-3)
      : cable({RopeLaw(stiff_steel), std::vector<double>(segment_lengths(x).size() - 1, friction), slider}),
        material(segment_lengths(x)),
        settled(material) {
    for (double& m : material) m *= slack;
  }
  Eigen::VectorXd force(const Eigen::VectorXd& x) {
    REQUIRE(cable.settle(chords_of(x), material, settled));
    return nodal_forces(x.size(),
                        [&](const auto& sink) { cable.segment_forces(chords_of(x), settled, sink); });
  }
  /// Moves to x and keeps the slip; returns what friction dissipated.
  double commit(const Eigen::VectorXd& x) {
    REQUIRE(cable.settle(chords_of(x), material, settled));
    const double loss = cable.energy(chords_of(x), material) - cable.energy(chords_of(x), settled);
    material = settled;
    dissipated += loss;
    return loss;
  }
  std::vector<double> tensions(const Eigen::VectorXd& x) const {
    std::vector<double> result;
    for (std::size_t i = 0; i < material.size(); ++i)
      result.push_back(cable.tension(chords_of(x)(i), material[i]));
    return result;
  }
};

/// A rope over `pins` fixed pins that wraps the same angle at each; free ends half a metre to a metre away.
Eigen::VectorXd capstan(int pins, double total_wrap) {
  const double turn = total_wrap / pins;
  Eigen::VectorXd x(3 * (pins + 2));
  core::Vector3 at(0, 0, 0);
  for (int k = 0; k < pins + 2; ++k) {
    x.segment<3>(3 * k) = at;
    const double angle = turn * k, length = k == 0 || k == pins ? 1.0 : 0.2;
    at += length * core::Vector3(std::cos(angle), std::sin(angle), 0.01);
  }
  return x;
}

double wrap(const Eigen::VectorXd& x) {
  const StackedChords chords = chords_of(x);
  double sum = 0;
  for (std::size_t k = 0; k + 1 < chords.size(); ++k)
    sum += std::acos(chords(k).normalized().dot(chords(k + 1).normalized()));
  return sum;
}

/// Pulls the last node outward in small steps until the rope runs.
void pull(TestRope& rope, Eigen::VectorXd& x, double distance, int steps) {
  const core::Vector3 out = chords_of(x)(chords_of(x).size() - 1).normalized();
  for (int k = 0; k < steps; ++k) {
    x.tail<3>() += out * (distance / steps);
    CHECK(rope.commit(x) >= -1e-15 * stiff_scale);
  }
}

}  // namespace

TEST_CASE(
    "a rope pulled over pins has the capstan ratio of tensions, both ways and in either order of its nodes") {
  constexpr double asked =
      1e-6;  // of the capstan row; friction is implicit, so the ratio is exact up to round-off
  for (const double mu : {0.1, 0.3, 0.5})
    for (const auto& [pins, total_wrap] :
         {std::pair{1, M_PI / 2}, std::pair{4, M_PI}, std::pair{12, 2 * M_PI}}) {
      Eigen::VectorXd x = capstan(pins, total_wrap);
      const double expected = std::exp(mu * wrap(x));
      TestRope rope(mu, x, 0.999);
      Eigen::VectorXd y = reversed(x);
      TestRope backward(mu, y, 0.999);
      pull(rope, x, 0.1, 50);
      CHECK(rope.tensions(x).back() / rope.tensions(x).front() == Approx(expected).epsilon(asked));
      CHECK(rope.dissipated > 0);
      // the same rope numbered from its other end, pulled at the same place
      for (int k = 1; k <= 50; ++k) {
        y.head<3>() = capstan(pins, total_wrap).tail<3>() +
                      (x.tail<3>() - capstan(pins, total_wrap).tail<3>()) * (k / 50.0);
        backward.commit(y);
      }
      for (std::size_t i = 0; i < rope.material.size(); ++i)
        CHECK(backward.material[rope.material.size() - 1 - i] == Approx(rope.material[i]).epsilon(1e-12));
      // and back again
      pull(rope, x, -0.1, 50);
      CHECK(rope.tensions(x).front() / rope.tensions(x).back() == Approx(expected).epsilon(asked));
    }
}

TEST_CASE("a quarter turn at mu = 0.3 leaves exp(-0.3 pi/2) of the tension") {
  Eigen::VectorXd x(9);
  x << 0, 1, 0, 0, 0, 0, 1, 0, 0;
  TestRope rope(0.3, x, 0.999);
  pull(rope, x, 0.01, 20);
  CHECK(rope.tensions(x).front() / rope.tensions(x).back() ==
        Approx(std::exp(-0.3 * M_PI / 2)).epsilon(1e-9));
}

TEST_CASE("a rope sticks while its tensions stay within the capstan limit") {
  Eigen::VectorXd x(9);
  x << 0, 1, 0, 0, 0, 0, 1, 0, 0;
  TestRope rope(0.3, x, 0.999);
  const std::vector<double> before = rope.material;
  x[6] += 1e-4;  // strains 1e-3 and 1.1e-3: ratio 1.1 < exp(0.47)
  CHECK(rope.commit(x) == 0);
  CHECK(rope.material == before);
  CHECK(rope.tensions(x).back() / rope.tensions(x).front() == Approx(1.1).epsilon(0.01));
}

namespace {

/// What of a settled rope breaks a law: the first thing, or nothing.
std::string broken_law(const TestRope& rope, const Eigen::VectorXd& x, double mu,
                       const std::vector<double>& before, int& slipping) {
  constexpr double round_off = 1e-12;  // of E A: tension is a difference of lengths
  const double held = total(before);
  if (!(std::abs(total(rope.material) - held) < 1e-13 * held)) return "material is lost";
  const std::vector<double> N = rope.tensions(x);
  const StackedChords chords = chords_of(x);
  double passed = 0;
  for (std::size_t k = 0; k + 1 < N.size(); ++k) {
    const double a = std::exp(mu * std::acos(chords(k).normalized().dot(chords(k + 1).normalized())));
    const double forwards = N[k + 1] - a * N[k], backwards = N[k] - a * N[k + 1];
    if (!(std::max(forwards, backwards) <= round_off * stiff_scale)) return "a tension is above the limit";
    passed += before[k] - rope.material[k];
    if (passed > no_slip * held && !(std::abs(forwards) < round_off * stiff_scale))
      return "it slips below the limit";
    if (passed < -no_slip * held && !(std::abs(backwards) < round_off * stiff_scale))
      return "it slips below the limit";
    slipping += std::abs(passed) > no_slip * held;
  }
  return "";
}

void check_settled_ropes(int ropes, unsigned seed) {
  Dice dice(seed);
  int slipping = 0, slack = 0;
  for (int trial = 0; trial < ropes; ++trial) {
    const double mu = dice.decades(1e-3, 1);
    Eigen::VectorXd x = winding_rope(dice, 3 + trial % 12);
    TestRope rope(mu, x, dice.uniform(0.95, 1.02));
    // any distribution of material whatever: up to half of a segment's share is elsewhere
    const double held = total(rope.material);
    for (double& m : rope.material) m *= dice.uniform(0.5, 1.5);
    const double factor = held / total(rope.material);
    for (double& m : rope.material) m *= factor;
    const std::vector<double> before = rope.material;
    const double loss = rope.commit(x);
    const std::string broken =
        loss >= -1e-13 * stiff_scale ? broken_law(rope, x, mu, before, slipping) : "it gains";
    if (!broken.empty()) FAIL("rope " << trial << ": " << broken);
    slack += rope.tensions(x).front() == 0;
  }
  CHECK(slipping > 5 * ropes / 2);
  CHECK(slack > ropes / 20);
}

}  // namespace

TEST_CASE("settled tensions obey the capstan limit at every node whatever the rope has been through") {
  check_settled_ropes(500, 41);
}

TEST_CASE("settled tensions of 20 000 ropes more obey the capstan limit at every node", "[long]") {
  check_settled_ropes(20000, 42);
}

TEST_CASE("slip does not depend on the direction the nodes are numbered in") {
  Dice dice(42);
  for (int trial = 0; trial < 500; ++trial) {
    const Eigen::VectorXd x = winding_rope(dice, 8);
    TestRope rope(0.2, x, dice.uniform(0.98, 1.01)), backward(0.2, reversed(x), 1);
    for (double& m : rope.material) m *= dice.uniform(0.99, 1.01);
    backward.material.assign(rope.material.rbegin(), rope.material.rend());
    rope.commit(x);
    backward.commit(reversed(x));
    for (std::size_t i = 0; i < rope.material.size(); ++i)
      CHECK(std::abs(backward.material[rope.material.size() - 1 - i] - rope.material[i]) < 1e-12);
  }
}

TEST_CASE("friction that fades leaves the sliding cable") {
  Dice dice(43);
  const Eigen::VectorXd x = winding_rope(dice, 9);
  TestRope rope(1e-15, x, 0.99);
  const double held = total(rope.material);
  for (double& m : rope.material) m *= dice.uniform(0.9, 1.1);
  const double factor = held / total(rope.material);
  for (double& m : rope.material) m *= factor;
  const SlidingCable free{RopeLaw(stiff_steel), held, 1e-3};
  CHECK((rope.force(x) - sliding_force(free, x)).norm() < 1e-12 * stiff_scale);
}

TEST_CASE("the stiffness of a frictional cable is the derivative of its settled force") {
  Dice dice(44);
  int mixed = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::VectorXd X = winding_rope(dice, 3 + trial % 5);
    TestRope rope(0.3, X, 0.98);
    const Eigen::VectorXd x = X + 0.02 * Eigen::VectorXd::Random(X.size());
    const auto force = [&](const Eigen::VectorXd& y) { return rope.force(y); };
    const Eigen::MatrixXd difference = central_differences(force, x, 1e-6),
                          coarser = central_differences(force, x, 4e-6);
    if ((difference - coarser).norm() > 1e-6 * stiff_scale)
      continue;  // a node changes between stick and slip here
    rope.force(x);
    std::size_t moving = 0;
    double passed = 0;
    for (std::size_t k = 0; k + 1 < rope.material.size(); ++k)
      moving += std::abs(passed += rope.material[k] - rope.settled[k]) > no_slip;
    mixed += moving > 0 && moving + 1 < rope.material.size();
    const Eigen::MatrixXd K = nodal_stiffness(
        x.size(), [&](const auto& sink) { rope.cable.stiffness(chords_of(x), rope.material, sink); });
    CHECK((difference - K).norm() < 1e-6 * stiff_scale);
  }
  CHECK(mixed > 30);
}

TEST_CASE(
    "a rope held at its nodes has the stiffness of its segments, above that of one that slips along any "
    "motion") {
  Dice dice(45);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::VectorXd x = winding_rope(dice, 6);
    TestRope rope(0.2, x, 0.99);
    rope.commit(x);
    const Eigen::VectorXd w = Eigen::VectorXd::Random(x.size());
    const Eigen::VectorXd held = nodal_forces(x.size(), [&](const auto& sink) {
      rope.cable.held_stiffness_product(chords_of(x), chords_of(w), rope.material, sink);
    });
    const auto held_force = [&](const Eigen::VectorXd& y) {
      return nodal_forces(
          y.size(), [&](const auto& sink) { rope.cable.segment_forces(chords_of(y), rope.material, sink); });
    };
    // steps of 1e-6 m on metres: 1e-12 of curvature, 1e-10 of round-off
    const Eigen::VectorXd difference = (held_force(x + 1e-6 * w) - held_force(x - 1e-6 * w)) / 2e-6;
    CHECK((difference - held).norm() < 1e-7 * stiff_scale * w.norm());
    const SlidingCable free{RopeLaw(stiff_steel), total(rope.material), 1e-3};
    const Eigen::VectorXd running = nodal_forces(
        x.size(), [&](const auto& sink) { free.stiffness_product(chords_of(x), chords_of(w), sink); });
    CHECK(w.dot(held) >= w.dot(running) - 1e-12 * stiff_scale);
  }
}

TEST_CASE("a slack rope takes up its slack before it pulls") {
  Eigen::VectorXd x(12);
  x << 0, 0, 0, 1, 0, 0, 1, 1, 0, 2, 1, 0;
  TestRope rope(0.4, x, 1.01);
  rope.material = {0.98, 1.02, 1.03};  // the first segment alone would be taut
  rope.commit(x);
  for (const double N : rope.tensions(x)) CHECK(N <= 1e-12 * stiff_scale);
  CHECK(total(rope.material) == Approx(3.03).epsilon(1e-14));
  // least squares: both givers give the same
  CHECK(1.02 - rope.material[1] == Approx(1.03 - rope.material[2]).epsilon(1e-9));
}

TEST_CASE(
    "a rope rubbed to and fro dissipates the work of its end, and ends where its last turn left it, not "
    "where it "
    "began") {
  Eigen::VectorXd x = capstan(3, M_PI);
  TestRope rope(0.3, x, 0.999);
  const std::vector<double> start = rope.material;
  const double ratio = std::exp(0.3 * wrap(x));
  const core::Vector3 out = chords_of(x)(chords_of(x).size() - 1).normalized();
  std::vector<double> before;
  for (int cycle = 0; cycle < 3; ++cycle) {
    const double dissipated = rope.dissipated;
    double work = 0;
    constexpr int steps = 1000;  // a way; at 200 the work of the end is off by 1.4 %
    for (const double way : {0.01, -0.01})
      for (int k = 0; k < steps; ++k) {
        const double tension = rope.tensions(x).back();
        x.tail<3>() += way / steps * out;
        rope.commit(x);
        work += 0.5 * (tension + rope.tensions(x).back()) * way / steps;
      }
    CHECK(rope.tensions(x).front() / rope.tensions(x).back() == Approx(ratio).epsilon(1e-6));
    for (std::size_t i = 0; cycle > 0 && i < before.size(); ++i)
      CHECK(rope.material[i] == Approx(before[i]).epsilon(1e-9));
    // From the second cycle on the rope ends as it began, so that nothing else can have become of the work.
    if (cycle > 0) CHECK(rope.dissipated - dissipated == Approx(work).epsilon(0.01));
    CHECK(rope.material.front() - start.front() < -1e-4);  // m; has gone over the pins
    CHECK(rope.material.back() - start.back() > 1e-4);
    before = rope.material;
  }
}
