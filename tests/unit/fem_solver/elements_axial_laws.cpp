#include <catch2/catch.hpp>

#include "core/errors.hpp"
#include "fem_solver/elements/path_segment.hpp"
#include "tests/support/finite_differences.hpp"
#include "tests/unit/fem_solver/elements_support.hpp"

using namespace talus;
using namespace talus::fem;
using namespace talus::test;

namespace {

const ElasticPlasticRope rope{{1e-4, 1e11, 1e8}, 5e8, 2e9};
const BrakeLaw ring({{{0.02, 40e3}, {0.5, 60e3}, {0.8, 50e3}, {1.0, 90e3}}, 5e6, 0.05});

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
