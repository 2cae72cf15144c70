#include "fem_solver/elements/axial.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <random>

namespace {

using namespace talus::fem;

/// Random axial elements and states in all directions, taut and slack, at strains up to about 1/2.
class RandomStates {
 public:
  Vector3 vector(double size) {
    return size * Vector3(uniform_(random_), uniform_(random_), uniform_(random_));
  }
  template <class Compression>
  AxialElement<Compression> element() {
    const Vector3 reference = Vector3(1, 0.3, -0.2) + vector(0.5);
    const AxialSection section{.area = 2e-4, .youngs_modulus = 3e6, .prestress = 5e5 * uniform_(random_)};
    return {reference, 1 / reference.norm(), section};
  }

 private:
  std::mt19937_64 random_{7};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// Central differences are exact to about step^2 = 1e-10 of the third derivative, and to rounding over step =
/// 1e-11 of the value.
constexpr double difference_step = 1e-5;
constexpr double difference_tolerance = 1e-8;

template <class Compression>
void check_derivatives() {
  RandomStates states;
  for (int sample = 0; sample < 200; ++sample) {
    const auto element = states.element<Compression>();
    const Vector3 stretch = states.vector(0.4);
    if (std::abs(element.trial_stress(element.strain(stretch))) < 1e3)
      continue;  // the kink between taut and slack
    const double scale = element.section.area * (element.section.youngs_modulus + 5e5);
    for (int c = 0; c < 3; ++c) {
      const Vector3 h = difference_step * Vector3::Unit(c);
      const double slope =
          (element.energy(stretch + h) - element.energy(stretch - h)) / (2 * difference_step);
      CHECK(element.force(stretch)[c] == Approx(slope).margin(difference_tolerance * scale));
      const Vector3 column =
          (element.force(stretch + h) - element.force(stretch - h)) / (2 * difference_step);
      CHECK((element.stiffness(stretch).col(c) - column).norm() < difference_tolerance * scale);
    }
  }
}

}  // namespace

TEST_CASE(
    "the force of a bar and of a cable is the derivative of its energy, the stiffness that of its force") {
  check_derivatives<CarriesCompression>();
  check_derivatives<TensionOnly>();
}

TEST_CASE("the force equals the normal force N = A (E e + S_pre) l/L along the current direction") {
  RandomStates states;
  for (int sample = 0; sample < 100; ++sample) {
    const auto element = states.element<CarriesCompression>();
    const Vector3 stretch = states.vector(0.4), d = element.reference + stretch;
    const double L = element.reference.norm(), l = d.norm(), e = (l * l - L * L) / (2 * L * L);
    const AxialSection& s = element.section;
    const double N = s.area * (s.youngs_modulus * e + s.prestress) * l / L;
    CHECK((element.force(stretch) - N * d / l).norm() <= 1e-13 * s.area * s.youngs_modulus);
    CHECK(element.axial_force(stretch) == Approx(N).epsilon(1e-12));
  }
}

TEST_CASE("the stiffness equals (EA/L)(1 + 3e + S_pre/E) t t^T + (N/l)(I - t t^T)") {
  RandomStates states;
  for (int sample = 0; sample < 100; ++sample) {
    const auto element = states.element<CarriesCompression>();
    const Vector3 stretch = states.vector(0.4), d = element.reference + stretch, t = d.normalized();
    const double L = element.reference.norm(), l = d.norm(), e = element.strain(stretch);
    const AxialSection& s = element.section;
    const Matrix3 along = t * t.transpose();
    const Matrix3 K = s.youngs_modulus * s.area / L * (1 + 3 * e + s.prestress / s.youngs_modulus) * along +
                      element.axial_force(stretch) / l * (Matrix3::Identity() - along);
    CHECK((element.stiffness(stretch) - K).norm() < 1e-12 * K.norm());
    const Vector3 direction = states.vector(1);
    CHECK((element.stiffness_product(stretch, direction) - K * direction).norm() < 1e-12 * K.norm());
  }
}

TEST_CASE("a cable shorter than its slack length carries nothing and has no stiffness") {
  const AxialElement<TensionOnly> cable{
      {1, 0, 0}, 1, {.area = 1e-4, .youngs_modulus = 1e9, .prestress = 1e6}};
  const Vector3 slack(-0.1, 0, 0);
  CHECK(cable.force(slack).isZero(0));
  CHECK(cable.stiffness(slack).isZero(0));
  CHECK(cable.axial_force(slack) == 0);
  CHECK(cable.energy(slack) == cable.energy(2 * slack));
}

TEST_CASE("a segment squeezed to nothing gives a finite force") {
  const AxialElement<CarriesCompression> bar{
      {1, 2, 3}, 1 / std::sqrt(14.0), {.area = 1e-4, .youngs_modulus = 1e9, .prestress = 0}};
  CHECK(bar.force({-1, -2, -3}).isZero(0));
}

TEST_CASE("rotating the state rotates the force and keeps the energy") {
  RandomStates states;
  const Matrix3 rotation = Eigen::AngleAxisd(1.1, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  for (int sample = 0; sample < 50; ++sample) {
    const auto element = states.element<TensionOnly>();
    auto turned = element;
    turned.reference = rotation * element.reference;
    const Vector3 stretch = states.vector(0.4);
    const double scale = element.section.area * element.section.youngs_modulus;
    CHECK((turned.force(rotation * stretch) - rotation * element.force(stretch)).norm() < 1e-13 * scale);
    CHECK(turned.energy(rotation * stretch) == Approx(element.energy(stretch)).margin(1e-13 * scale));
  }
}
