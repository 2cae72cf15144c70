#include <catch2/catch.hpp>
#include <cmath>

#include "fem_solver/materials/exact_wrinkles.hpp"
#include "fem_solver/materials/principal_wrinkles.hpp"
#include "fem_solver/materials/tension_field.hpp"
#include "tests/support/finite_differences.hpp"
#include "tests/unit/fem_solver/elements_support.hpp"

using namespace talus;
using namespace talus::fem;
using talus::test::Dice;

namespace {

using Exact = TensionField<ExactWrinkles>;
using Principal = TensionField<PrincipalWrinkles>;
constexpr PlaneStress<double> no_prestress{0, 0, 0};

PlaneElasticity isotropic(double E, double v) {
  return PlaneElasticity::from(IsotropicSheet{E, v});
}

/// Moduli over decades: nets are all but without shear stiffness, fabrics have E_x far from E_y.
PlaneElasticity random_orthotropic(Dice& dice, double decades) {
  const double Ex = dice.decades(1, std::pow(10, decades)), Ey = dice.decades(1, std::pow(10, decades));
  const double v = dice.uniform(-0.9, 0.9) * std::sqrt(Ey / Ex);
  return PlaneElasticity::from(
      OrthotropicSheet{Ex, Ey, v, dice.decades(std::pow(10, -decades), 10) * std::min(Ex, Ey)});
}

PlaneStrain<double> random_strain(Dice& dice) {
  return {dice.uniform(-0.02, 0.02), dice.uniform(-0.02, 0.02), dice.uniform(-0.02, 0.02)};
}

double smaller_principal(double xx, double yy, double xy) {
  return 0.5 * (xx + yy) - std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
}
double smaller_principal(const PlaneStress<double>& s) {
  return smaller_principal(s.xx, s.yy, s.xy);
}

Eigen::VectorXd stress_at(const auto& law, const Eigen::VectorXd& e) {
  return to_vector(law.stress(to_strain(e)));
}

constexpr double strain_step = 1e-7;
/// Relative error of the differences: step^2 against strains of 0.01 is 1e-10, round-off of the stress over
/// the step 1e-9; states near a change of branch amplify both.
constexpr double difference_accuracy = 2e-5;

/// The least distance of a state from a change between taut, wrinkled and slack, relative to its size.
bool far_from_branches(const PlaneElasticity& law, const PlaneStrain<double>& d) {
  const PlaneStress<double> s = law.stress(d);
  const double stress_size = to_vector(s).norm(), strain_size = to_vector(d).norm();
  const double larger = -smaller_principal(-d.xx, -d.yy, -0.5 * d.shear);
  return std::abs(smaller_principal(s)) > 1e-3 * stress_size && std::abs(larger) > 1e-3 * strain_size;
}

}  // namespace

TEST_CASE("the tension field of an isotropic sheet takes its closed-form values") {
  const Exact exact(isotropic(1, 0.3), no_prestress);
  const Principal principal(isotropic(1, 0.3), no_prestress);
  // pure shear gamma: strain gamma/2 along 45 degrees, uniaxial stress E gamma/2 there
  const double gamma = 0.01;
  const PlaneVector shear = PlaneVector(1, 1, 1) * gamma / 4;
  // uniaxial strain state with lateral contraction beyond Poisson's: wrinkled across x, stress E e_xx
  const PlaneVector pull(0.01, 0, 0);
  // (0.01, -0.004, 0.006): E times the larger principal strain along its direction
  const double mean = 0.003, half = 0.007, radius = std::hypot(half, 0.003), strain = mean + radius;
  const double cosine = half / radius, sine = 0.003 / radius;
  const PlaneVector mixed = strain * PlaneVector(0.5 * (1 + cosine), 0.5 * (1 - cosine), 0.5 * sine);
  CHECK((mixed - PlaneVector(0.010186604098, 0.000429169008, 0.002090878948)).norm() <
        1e-12);  // digits of the stored table
  constexpr double round_off = 1e-16;
  for (const auto& [e, expected] :
       {std::pair{PlaneVector(0, 0, gamma), shear}, std::pair{PlaneVector(0.01, -0.01, 0), pull},
        std::pair{PlaneVector(0.01, -0.004, 0.006), mixed}}) {
    CHECK((stress_at(exact, e) - expected).norm() < round_off);
    CHECK((stress_at(principal, e) - expected).norm() < round_off);
  }
}

TEST_CASE("a wrinkled shear panel keeps (1 + v)/2 of its shear stiffness") {
  for (const double v : {0.0, 0.3, 0.49}) {
    const Exact field(isotropic(2e9, v), no_prestress);
    const double gamma = 1e-3,
                 ratio = field.stress(PlaneStrain<double>{0, 0, gamma}).xy / (2e9 / (2 * (1 + v)) * gamma);
    CHECK(ratio == Approx((1 + v) / 2).epsilon(1e-14));
  }
}

TEST_CASE("a sheet is taut, wrinkled or slack where its principal values say so") {
  const Exact field(isotropic(1, 0.3), no_prestress);
  CHECK(field.state({0.01, 0.01, 0.001}) == SheetState::taut);
  CHECK(field.state({0.01, -0.0029, 0}) == SheetState::taut);  // lateral contraction below Poisson's 0.003
  CHECK(field.state({0.01, -0.0031, 0}) == SheetState::wrinkled);
  CHECK(field.state({-0.01, -0.001, 0}) == SheetState::slack);
  CHECK(field.state({0, 0, 0}) == SheetState::slack);
  const Exact prestressed(isotropic(1, 0.3), {0.02, 0.02, 0});
  CHECK(prestressed.state({0, 0, 0}) == SheetState::taut);
  CHECK(prestressed.state({-0.01, -0.01, 0}) == SheetState::taut);  // prestrain 0.014 both ways
  CHECK(prestressed.state({-0.015, -0.015, 0}) == SheetState::slack);
}

TEST_CASE("the exact tension field fulfils the conditions of the least energy in extreme sheets") {
  // The energy is convex in the added wrinkle strain P, so these conditions are necessary and sufficient for
  // the least energy: stress s >= 0, P = S s - d >= 0, s : P = 0 (as tensors).
  Dice dice(11);
  int wrinkled = 0;
  for (int trial = 0; trial < 200000; ++trial) {
    const PlaneElasticity law = random_orthotropic(dice, 4);
    const Exact field(law, no_prestress);
    const PlaneStrain<double> d = random_strain(dice);
    if (field.state(d) != SheetState::wrinkled) continue;
    ++wrinkled;
    const PlaneStress<double> s = field.stress(d);
    const PlaneStrain<double> elastic = law.strain(s);
    const PlaneStrain<double> P{elastic.xx - d.xx, elastic.yy - d.yy, elastic.shear - d.shear};
    const double stress_size = to_vector(s).norm(),
                 strain_size = to_vector(d).norm() + to_vector(elastic).norm();
    constexpr double round_off = 1e-9;  // of moduli 8 decades apart
    REQUIRE(std::isfinite(stress_size));
    REQUIRE(smaller_principal(s) >= -round_off * stress_size);
    REQUIRE(smaller_principal(P.xx, P.yy, 0.5 * P.shear) >= -round_off * strain_size);
    REQUIRE(std::abs(work(s, P)) <= round_off * stress_size * strain_size);
  }
  CHECK(wrinkled > 50000);
}

TEST_CASE("the exact tension field is the least energy over all wrinkle strains") {
  Dice dice(12);
  for (int trial = 0; trial < 200; ++trial) {
    const PlaneElasticity law = random_orthotropic(dice, 1.5);
    const Exact field(law, no_prestress);
    const PlaneStrain<double> d = random_strain(dice);
    const double energy = field.energy_density(d), unrelaxed = law.energy_density(d);
    double least = field.state(d) == SheetState::slack ? 0 : unrelaxed;
    constexpr int directions = 20000;
    for (int k = 0; k < directions; ++k) {
      const double a = M_PI * k / directions, c = std::cos(a), s = std::sin(a);
      const PlaneStrain<double> U{c * c, s * s, 2 * c * s};
      const double size = std::max(0.0, -work(law.stress(d), U) / work(law.stress(U), U));
      least = std::min(
          least, law.energy_density({d.xx + size * U.xx, d.yy + size * U.yy, d.shear + size * U.shear}));
    }
    // The energy varies by at most ~ C (d angle)^2 between sampled directions 1.6e-4 apart.
    CHECK(energy <= least * (1 + 1e-12) + 1e-18);
    CHECK(energy >= least - 1e-6 * unrelaxed);
  }
}

TEST_CASE(
    "the stress of the exact tension field is the gradient of its energy and its tangent that of its "
    "stress") {
  Dice dice(13);
  int counts[3] = {};
  for (int trial = 0; trial < 2000; ++trial) {
    const PlaneElasticity law = random_orthotropic(dice, 1);
    const PlaneStress<double> prestress{dice.uniform(0, 0.05), dice.uniform(0, 0.05), 0};
    const Exact field(law, prestress);
    const PlaneVector e = to_vector(random_strain(dice));
    const PlaneVector d = e + law.compliance() * to_vector(prestress);
    if (!far_from_branches(law, to_strain(d))) continue;
    ++counts[static_cast<int>(field.state(to_strain(e)))];
    const auto energy = [&](const Eigen::VectorXd& x) {
      return test::as_vector(field.energy_density(to_strain(x)));
    };
    const auto stress = [&](const Eigen::VectorXd& x) { return stress_at(field, x); };
    const double modulus = law.stiffness().norm();
    CHECK((test::central_differences(energy, e, strain_step).transpose() - stress(e)).norm() <
          difference_accuracy * modulus * d.norm());
    const PlaneMatrix tangent = field.tangent(to_strain(e));
    CHECK((test::central_differences(stress, e, strain_step) - tangent).norm() <
          difference_accuracy * modulus);
    CHECK((tangent - tangent.transpose()).norm() <= 1e-15 * modulus);
  }
  for (const int count : counts) CHECK(count > 100);
}

TEST_CASE("the tangent with principal wrinkles is the derivative of the stress in all three states") {
  Dice dice(14);
  int counts[3] = {};
  for (int trial = 0; trial < 2000; ++trial) {
    const PlaneElasticity law = random_orthotropic(dice, 1);
    const Principal field(law, no_prestress);
    const PlaneVector e = to_vector(random_strain(dice));
    const PlaneStress<double> s = law.stress(to_strain(e));
    const bool undirected =
        std::hypot(s.xx - s.yy, 2 * s.xy) < 0.05 * to_vector(s).norm();  // the direction turns too fast there
    if (!far_from_branches(law, to_strain(e)) || undirected) continue;
    ++counts[static_cast<int>(field.state(to_strain(e)))];
    const auto stress = [&](const Eigen::VectorXd& x) { return stress_at(field, x); };
    CHECK((test::central_differences(stress, e, strain_step) - field.tangent(to_strain(e))).norm() <
          difference_accuracy * law.stiffness().norm());
  }
  for (const int count : counts) CHECK(count > 100);
}

TEST_CASE("principal and exact wrinkles agree on isotropic sheets") {
  Dice dice(15);
  for (int trial = 0; trial < 1000; ++trial) {
    const PlaneElasticity law = isotropic(dice.decades(1, 1e11), dice.uniform(-0.5, 0.49));
    const Exact exact(law, no_prestress);
    const Principal principal(law, no_prestress);
    const PlaneStrain<double> e = random_strain(dice);
    const double modulus = law.stiffness().norm();
    constexpr double round_off = 1e-12;
    CHECK(to_vector(exact.stress(e)).isApprox(to_vector(principal.stress(e)), round_off));
    CHECK(std::abs(exact.energy_density(e) - principal.energy_density(e)) <=
          round_off * modulus * to_vector(e).squaredNorm());
    CHECK((exact.tangent(e) - principal.tangent(e)).norm() <= 1e-10 * modulus);
  }
}

TEST_CASE("the exact tension field carries no compression where principal wrinkles leave some") {
  Dice dice(16);
  double worst_exact = 0, worst_principal = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const PlaneElasticity law = random_orthotropic(dice, 1);
    const PlaneStrain<double> e = random_strain(dice);
    const PlaneStress<double> exact = Exact(law, no_prestress).stress(e),
                              principal = Principal(law, no_prestress).stress(e);
    const double size = to_vector(law.stress(e)).norm();
    worst_exact = std::min(worst_exact, smaller_principal(exact) / size);
    worst_principal = std::min(worst_principal, smaller_principal(principal) / size);
  }
  CHECK(worst_exact > -1e-12);
  CHECK(worst_principal < -0.1);
}

TEST_CASE("principal wrinkles of an orthotropic sheet have no potential") {
  const PlaneElasticity law = PlaneElasticity::from(OrthotropicSheet{2, 1, 0.1, 0.1});
  const Principal principal(law, no_prestress);
  const Exact exact(law, no_prestress);
  const PlaneVector centre(0.002, -0.004, 0.02);
  REQUIRE(principal.state(to_strain(centre)) == SheetState::wrinkled);
  const PlaneMatrix tangent = principal.tangent(to_strain(centre));
  CHECK((tangent - tangent.transpose()).norm() > 0.05 * tangent.norm());
  // Work along a closed square of strain, side 2 mm/m, by the midpoint rule; a potential would make it vanish
  // with the rule's error.
  const auto cycle_work = [&](const auto& field) {
    const PlaneVector corners[4] = {centre, centre + PlaneVector(2e-3, 0, 0),
                                    centre + PlaneVector(2e-3, 0, 2e-3), centre + PlaneVector(0, 0, 2e-3)};
    double sum = 0;
    constexpr int parts = 2000;
    for (int side = 0; side < 4; ++side) {
      const PlaneVector step = (corners[(side + 1) % 4] - corners[side]) / parts;
      for (int k = 0; k < parts; ++k) sum += stress_at(field, corners[side] + (k + 0.5) * step).dot(step);
    }
    return sum;
  };
  const double scale = exact.energy_density(to_strain(centre));
  CHECK(std::abs(cycle_work(exact)) < 1e-9 * scale);
  CHECK(std::abs(cycle_work(principal)) > 1e-4 * scale);
  // With the direction held, its energy bounds the exact one from above.
  CHECK(principal.energy_density(to_strain(centre)) > exact.energy_density(to_strain(centre)));
}

TEST_CASE("packed lanes of a tension field have the bits of one state at a time") {
  Dice dice(17);
  for (int trial = 0; trial < 500; ++trial) {
    const PlaneElasticity law = random_orthotropic(dice, 3);
    const Exact exact(law, {0.01, 0, 0});
    const Principal principal(law, {0.01, 0, 0});
    PlaneStrain<double> states[Lanes::size()];
    for (auto& state : states) state = random_strain(dice);
    const PlaneStrain<Lanes> packed{Lanes([&](std::size_t i) { return states[i].xx; }),
                                    Lanes([&](std::size_t i) { return states[i].yy; }),
                                    Lanes([&](std::size_t i) { return states[i].shear; })};
    const auto same_bits = [&](const auto& field) {
      const PlaneStress<Lanes> s = field.stress(packed);
      for (std::size_t i = 0; i < Lanes::size(); ++i) {
        const PlaneStress<double> one = field.stress(states[i]);
        CHECK((one.xx == s.xx[i] && one.yy == s.yy[i] && one.xy == s.xy[i]));
      }
    };
    same_bits(exact);
    same_bits(principal);
  }
}
