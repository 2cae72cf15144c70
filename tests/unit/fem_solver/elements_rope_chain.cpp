#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <numeric>

#include "fem_solver/elements/rope_friction.hpp"
#include "tests/unit/fem_solver/elements_support.hpp"

using namespace talus::fem;
using namespace talus::test;

namespace {

const RopeLaw wire({.area = 1e-4, .youngs_modulus = 1e11, .prestress = 0});
constexpr double stiffness_of_wire = 1e-4 * 1e11;  // N

/// A rope in any state that a run might reach, and some that none should.
struct RandomRope {
  std::vector<double> lengths, grips, old_material, material;

  explicit RandomRope(Dice& dice) {
    const auto segments = static_cast<std::size_t>(dice.uniform(2, 100));
    const double mu = dice.decades(0.02, 1), spread = dice.uniform(0, 1) < 0.3 ? 1e-6 : 0.3;
    for (std::size_t i = 0; i < segments; ++i) {
      lengths.push_back(dice.uniform(0, 1) < 0.2 ? dice.decades(spread, 1) : dice.uniform(0.5, 1.5));
      if (i == 0) continue;
      const double kind = dice.uniform(0, 1);  // straight, clamped, or led around something
      grips.push_back(kind < 0.1    ? 1
                      : kind < 0.15 ? std::numeric_limits<double>::infinity()
                                    : std::exp(mu * dice.uniform(0, M_PI)));
    }
    // Taut or slack as a whole by some per cent; far or near from where the last step left it.
    const double stretch = dice.uniform(0.98, 1.05), far = dice.decades(1e-6, 0.9);
    for (const double l : lengths) old_material.push_back(l / stretch * dice.uniform(1 - far, 1 + far));
    material = old_material;
  }
  double tension(std::size_t i) const { return wire.tension(lengths[i] / material[i]); }
  double held(const std::vector<double>& m) const { return std::accumulate(m.begin(), m.end(), 0.0); }

  /// dN/d ln M at its largest (N): what round-off of lengths is multiplied by. E A, or more in a segment between clamps
  /// that was left with little material.
  double scale() const {
    double largest = stiffness_of_wire;
    for (std::size_t i = 0; i < material.size(); ++i)
      largest = std::max(largest, wire.taut_slope(lengths[i] / material[i]) * lengths[i] / material[i]);
    return largest;
  }
  /// What breaks the rules of friction most (N): limits, and that what has slipped stands at its limit. Round-off
  /// of a sum of lengths is felt by segments in the ratio of their material to the sum's.
  double violation() const {
    const double whole = held(old_material);
    double worst = 0, passed = 0;
    for (std::size_t k = 0; k + 1 < material.size(); ++k) {
      const double near = tension(k), far = tension(k + 1), a = grips[k];
      passed += old_material[k] - material[k];
      if (std::isinf(a)) {
        worst = std::max(worst, std::abs(passed) > 1e-13 * whole ? stiffness_of_wire : 0);
        continue;
      }
      worst = std::max({worst, far - a * near, near - a * far});
      if (passed > 1e-13 * whole) worst = std::max(worst, std::abs(far - a * near));
      if (passed < -1e-13 * whole) worst = std::max(worst, std::abs(near - a * far));
    }
    return worst;
  }
};

/// Friction of the rope by the means that runs use, or by the exact answer alone.
void check_ropes(int ropes, std::uint64_t seed) {
  Dice dice(seed);
  RopeFriction friction;
  RopeChain chain;
  int slipping = 0, slack = 0;
  for (int k = 0; k < ropes; ++k) {
    RandomRope rope(dice);
    const bool alone = k % 2 == 0;
    friction.resize(rope.material.size());
    std::vector<double> slips(rope.grips.size());
    const RopeState state{rope.lengths, rope.grips};
    REQUIRE((alone ? chain.solve(wire, state, rope.old_material, rope.material, slips)
                   : friction.settle(wire, state, rope.old_material, rope.material)));
    INFO("rope " << k << " of " << rope.material.size() << " segments");
    const double whole = rope.held(rope.old_material);
    REQUIRE(std::abs(rope.held(rope.material) - whole) <
            1e-14 * whole * std::sqrt(double(rope.material.size())));
    // Tension is a difference of lengths: its round-off is 1e-16 of E A, that of sums of a hundred terms ten times
    // that, and limits multiply it by up to exp(pi) at each of several nodes: 1e-3 N of 10 MN.
    REQUIRE(rope.violation() < 1e-10 * rope.scale());
    REQUIRE(std::ranges::all_of(rope.material, [](double m) { return m > 0; }));
    slipping += rope.material != rope.old_material;
    slack += rope.tension(0) == 0;
  }
  CHECK(slipping > 0.8 * ropes);
  CHECK(slack > 0.05 * ropes);
}

}  // namespace

TEST_CASE("random ropes end in the state that friction allows") {
  check_ropes(500, 61);
}

TEST_CASE("100 000 random ropes more end in the state that friction allows", "[long]") {
  check_ropes(100000, 62);
}

// Two minutes: test_fem_elements '[million]'
TEST_CASE("a million random ropes end in the state that friction allows", "[.][million]") {
  check_ropes(1000000, 63);
}

TEST_CASE(
    "the stretch at a tension is the inverse of the tension at a stretch, whatever the prestress "
    "and the guess") {
  Dice dice(63);
  for (int k = 0; k < 10000; ++k) {
    const RopeLaw law({.area = 1e-4, .youngs_modulus = 1e9, .prestress = 1e9 * dice.uniform(-0.3, 0.8)});
    const double q = law.slack_stretch() + dice.decades(1e-9, 10), N = law.tension(q);
    if (!(N > 0)) continue;
    // as far as N itself tells q
    CHECK(std::abs(law.stretch_at(N, dice.decades(0.1, 10)) - q) <
          4e-16 * q + 2e-15 * 1e5 * (1 + q * q) * q / law.tension_slope(q));
  }
}

TEST_CASE("a rope whose length is not finite has no answer") {
  RopeChain chain;
  const std::vector<double> lengths{1, std::numeric_limits<double>::quiet_NaN()}, grips{1.1}, old{1, 1};
  std::vector<double> material(2), slips(1);
  CHECK_FALSE(chain.solve(wire, {lengths, grips}, old, material, slips));
}
