#include <catch2/catch.hpp>

#include "core/errors.hpp"
#include "fem_solver/elements/path_segment.hpp"
#include "fem_solver/materials/ring_law.hpp"
#include "tests/support/finite_differences.hpp"
#include "tests/unit/fem_solver/elements_support.hpp"

using namespace talus;
using namespace talus::fem;
using namespace talus::test;

namespace {

const ElasticPlasticRope rope{{1e-4, 1e11, 1e8}, 5e8, 2e9};
const BrakeLaw ring({{{0.02, 40e3}, {0.5, 60e3}, {0.8, 50e3}, {1.0, 90e3}}, 5e6, 0.05});

const RingLaw wire_ring({2.6, 5e3}, {3, 50e3});

/// Random walk of the length: work done by the trapezoid rule of fine steps, and what the law says of it.
template <class Law>
void check_energy(const Law& law, double longest, unsigned seed) {
  Dice dice(seed);
  const double L = 2;
  double l = L, history = 0, work = 0, dissipated_before = 0;
  double force = law.respond({l, L}, history).force;
  const double start = law.stored({l, L}, history);
  for (int leg = 0; leg < 40; ++leg) {
    const double target = L + dice.uniform(-0.1, 1) * longest;
    constexpr int parts = 4000;
    const double step = (target - l) / parts;
    for (int k = 0; k < parts; ++k) {
      l += step;
      const AxialResponse response = law.respond({l, L}, history);
      REQUIRE(response.force >= 0);
      REQUIRE(response.history >= history);
      work += 0.5 * (force + response.force) * step;
      force = response.force;
      history = response.history;
      const double dissipated = law.dissipated({l, L}, history);
      REQUIRE(dissipated >=
              dissipated_before - 1e-12 * law.respond({L + longest, L}, 0).force * longest);  // round-off
      dissipated_before = dissipated;
    }
    const double balance = law.stored({l, L}, history) + law.dissipated({l, L}, history) - start;
    // trapezoid rule over kinks: second order in steps of 1/4000 of a leg
    CHECK(balance == Approx(work).epsilon(1e-4).margin(1e-4 * force * longest));
  }
  CHECK(dissipated_before > 0);
}

}  // namespace

TEST_CASE("work done on a law with memory is stored or dissipated, and the dissipated never falls") {
  check_energy(rope, 0.02, 61);
  check_energy(ring, 1.3, 62);
  check_energy(wire_ring, 1.3, 65);
}

TEST_CASE("the stiffness of a segment with memory is the derivative of its force") {
  Dice dice(63);
  const auto check = [&](const auto& law, double longest, double yielded) {
    const PathSegment<std::decay_t<decltype(law)>> segment{law, 2};
    for (int trial = 0; trial < 100; ++trial) {
      const Vector3 chord = dice.rotation().col(0) * (2 + dice.uniform(-0.1, 1) * longest);
      const double history = dice.uniform(0, yielded);
      const auto force = [&](const Eigen::VectorXd& d) {
        const Vector3 c = d;
        return Eigen::VectorXd(segment.force(c, segment.respond(c, history)));
      };
      const Eigen::MatrixXd fine = central_differences(force, chord, 1e-7),
                            coarse = central_differences(force, chord, 4e-7);
      const Matrix3 K = segment.stiffness(chord, segment.respond(chord, history));
      if ((fine - coarse).norm() > 1e-5 * (1 + K.norm())) continue;  // across a kink of the law
      CHECK((fine - K).norm() < 1e-5 * (1 + K.norm()));
    }
  };
  check(rope, 0.03, 0.01);
  check(ring, 1.3, 1.0);
  check(wire_ring, 1.3, 1.0);
}

TEST_CASE("an elastic-plastic rope yields at its yield stress, hardens and unloads elastically") {
  const double L = 2, E = 1e11, H = 2e9, A = 1e-4;
  const auto length_at = [L](double e) { return L * std::sqrt(1 + 2 * e); };
  const double e_yield = (5e8 - 1e8) / E;
  const auto stress = [&](double l, double history) {
    return rope.respond({l, L}, history).force / A * L / l;
  };
  CHECK(stress(length_at(e_yield), 0) == Approx(5e8).epsilon(1e-10));
  CHECK(rope.respond({length_at(0.999 * e_yield), L}, 0).history == 0);
  const double e = 0.02, p = rope.respond({length_at(e), L}, 0).history;
  CHECK(stress(length_at(e), 0) == Approx(5e8 + (e - e_yield) * E * H / (E + H)).epsilon(1e-10));
  CHECK(stress(length_at(e), 0) == Approx(5e8 + H * p).epsilon(1e-10));
  // unloading by 1e-3 of strain takes E times that off
  CHECK(stress(length_at(e - 1e-3), p) == Approx(5e8 + H * p - 1e-3 * E).epsilon(1e-10));
  CHECK(rope.respond({L, L}, p).force == 0);  // longer than it was: slack at its old length
}

TEST_CASE("a brake follows its table, unloads at the initial stiffness and stops at its end") {
  const double L = 2, k0 = 40e3 / 0.02;
  const auto force = [&](double u, double history) { return ring.respond({L + u, L}, history).force; };
  CHECK(force(0.01, 0) == Approx(20e3));
  CHECK(force(0.26, 0) == Approx(50e3));     // midway between (0.02, 40 kN) and (0.5, 60 kN)
  CHECK(force(0.65, 0.26) == Approx(55e3));  // on the falling piece
  CHECK(force(0.26 - 0.005, 0.26) == Approx(50e3 - 0.005 * k0));
  CHECK(force(0.26 - 0.03, 0.26) == 0);  // ran out by 50 kN/k0 = 0.025
  CHECK(force(-0.1, 0) == 0);
  // end stop: past its width a straight line of 5e6 N/m on top of the last force
  CHECK(force(1.1, 1.0) - force(1.09, 1.0) == Approx(5e6 * 0.01).epsilon(1e-9));
  CHECK(ring.respond({L + 1.0, L}, 1.0).slope == Approx(0).margin(1e-9));  // comes in smoothly
  // monotonic pull to 0.5: area under the table less what unloading gives back
  const double area = 0.5 * 0.02 * 40e3 + 0.48 * 50e3;
  CHECK(ring.dissipated({L + 0.5, L}, 0.5) == Approx(area - 60e3 * 60e3 / (2 * k0)).epsilon(1e-12));
  CHECK(ring.stored({L + 0.5, L}, 0.5) == Approx(60e3 * 60e3 / (2 * k0)).epsilon(1e-12));
}

TEST_CASE("tables that no brake can follow are refused with the point at fault") {
  using Catch::Matchers::Contains;
  const auto make = [](std::vector<std::pair<double, double>> table) {
    return BrakeLaw({std::move(table), 1e6, 0.1});
  };
  CHECK_THROWS_AS(make({}), core::ConfigError);
  CHECK_THROWS_WITH(make({{0.1, 100}, {0.05, 120}}), Contains("(0.05 m, 120 N)"));
  CHECK_THROWS_WITH(make({{0.1, 100}, {0.2, 900}}), Contains("steeper (8000 N/m)"));
  CHECK_THROWS_WITH(make({{0.1, 100}, {0.2, -5}}), Contains("-5 N"));
  CHECK_THROWS_WITH(BrakeLaw({{{0.1, 100}}, 0, 0.1}), Contains("end stop"));
}

namespace {

constexpr double L0 = 2;  // m; of a segment that is pulled apart

/// A segment pulled slowly until it breaks.
struct Pulled {
  double length = L0, force = 0, work = 0, history = 0;  ///< of the last step in which it pulls
  bool broke = false;
};
template <class Law>
Pulled pull_apart(const Breaking<Law>& law, double longest) {
  constexpr int steps = 100000;
  Pulled pulled;
  pulled.force = law.respond({L0, L0}, 0).force;
  for (int k = 1; k <= steps && !pulled.broke; ++k) {
    const double length = L0 + longest * k / steps;
    const AxialResponse response = law.respond({length, L0}, pulled.history);
    pulled.work += 0.5 * (pulled.force + response.force) * (length - pulled.length);
    pulled = {length, response.force, pulled.work, response.history, law.is_broken(response.history)};
  }
  return pulled;
}

}  // namespace

TEST_CASE("a segment breaks at its force, strain or work, and pulls no more") {
  const ElasticRope elastic{{1e-4, 1e11, 1e8}};
  const double stiffness = 1e-4 * 1e11;  // E A
  const Pulled by_force = pull_apart(Breaking<ElasticRope>{elastic, {.force = 60e3}}, 0.02);
  CHECK(by_force.broke);
  CHECK(by_force.force == Approx(60e3).epsilon(1e-3));
  const Pulled by_strain = pull_apart(Breaking<ElasticRope>{elastic, {.strain = 0.004}}, 0.02);
  CHECK(by_strain.broke);
  CHECK(by_strain.length == Approx(L0 * 1.004).epsilon(1e-6));
  // Work since slack, where the strain was 1e8/1e11 less: E A L (e + 1e-3)^2/2.
  const double work = 120;
  const Pulled by_work = pull_apart(Breaking<ElasticRope>{elastic, {.work = work}}, 0.02);
  CHECK(by_work.broke);
  const double q = by_work.length / L0;
  CHECK(0.5 * (q * q - 1) == Approx(std::sqrt(2 * work / (stiffness * L0)) - 1e-3).epsilon(1e-3));
  CHECK_FALSE(pull_apart(Breaking<ElasticRope>{elastic, {.force = 1e6}}, 0.02).broke);

  const Breaking<ElasticRope> law{elastic, {.force = 60e3}};
  const AxialResponse after = law.respond({2 * L0, L0}, by_force.history);
  CHECK(after.force == 0);
  CHECK(after.slope == 0);
  CHECK(after.history == by_force.history);  // broken for good
}

TEST_CASE(
    "what a breaking segment has stored and dissipated goes on without a jump, and is the work done on it") {
  const auto check = [](const auto& law) {
    const Pulled pulled = pull_apart(law, 0.5);
    REQUIRE(pulled.broke);
    const SegmentLengths lengths{pulled.length, L0}, far{2 * L0, L0};
    const double start = law.stored({L0, L0}, 0);
    const double before = law.law.stored(lengths, law.law.respond(lengths, 0).history) +
                          law.law.dissipated(lengths, law.law.respond(lengths, 0).history);
    const double after = law.stored(lengths, pulled.history) + law.dissipated(lengths, pulled.history);
    CHECK(after == Approx(before).epsilon(1e-12));
    CHECK(after - start == Approx(pulled.work).epsilon(1e-4));
    CHECK(law.stored(far, pulled.history) + law.dissipated(far, pulled.history) == after);
    CHECK(law.dissipated(lengths, pulled.history) > 0);
  };
  check(Breaking<ElasticRope>{{{1e-4, 1e11, 1e8}}, {.force = 60e3}});
  check(Breaking<ElasticRope>{{{1e-4, 1e11, 0}}, {.strain = 0.003}});
  check(Breaking<ElasticPlasticRope>{rope, {.strain = 0.05}});
  check(Breaking<ElasticPlasticRope>{rope, {.work = 2000}});
  check(Breaking<RingLaw>{RingLaw({2.2, 5e3}, {2.4, 50e3}), {.force = 50e3}});
}

TEST_CASE("an elastic rope is the cable of the axial element") {
  Dice dice(64);
  for (int trial = 0; trial < 200; ++trial) {
    const AxialSection section{1e-4, dice.decades(1e8, 1e11), dice.uniform(-1e8, 1e8)};
    const Vector3 reference = dice.vector(2), stretch = dice.vector(0.1);
    const AxialElement<TensionOnly> cable{reference, 1 / reference.norm(), section};
    const ElasticRope law{section};
    const PathSegment<ElasticRope> segment{law, reference.norm()};
    const Vector3 chord = reference + stretch;
    const AxialResponse response = segment.respond(chord, 0);
    const double scale = section.area * section.youngs_modulus;
    CHECK((segment.force(chord, response) - cable.force(stretch)).norm() < 1e-13 * scale);
    CHECK((segment.stiffness(chord, response) - cable.stiffness(stretch)).norm() < 1e-11 * scale);
    CHECK(segment.stored(chord, 0) == Approx(cable.energy(stretch)).margin(1e-13 * scale));
  }
}
