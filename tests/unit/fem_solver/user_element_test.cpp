#include <catch2/catch.hpp>
#include <cmath>

#include "fem_solver/elements/user_element.hpp"
#include "tests/unit/fem_solver/structural_scenes.hpp"

namespace {

using namespace talus::fem;
namespace tests = talus::fem::tests;

/// The bar of this project once more, as a user would write it: U = A L E e^2/2 in Green-Lagrange strain.
class Bar final : public UserElement {
 public:
  Bar(std::span<const double> reference, const std::vector<double>& parameters)
      : stiffness_(parameters.at(0)), mass_per_length_(parameters.at(1)), L_(std::sqrt(squared(reference))) {}
  double energy(std::span<const double> x) const override {
    return 0.5 * stiffness_ * L_ * strain(x) * strain(x);
  }
  void force(std::span<const double> x, std::span<double> f) const override {
    for (std::size_t c = 0; c < 3; ++c) {
      f[3 + c] = stiffness_ * strain(x) / L_ * (x[3 + c] - x[c]);
      f[c] = -f[3 + c];
    }
  }
  void masses(std::span<double> m) const override { m[0] = m[1] = 0.5 * mass_per_length_ * L_; }

 private:
  static double squared(std::span<const double> x) {
    return std::pow(x[3] - x[0], 2) + std::pow(x[4] - x[1], 2) + std::pow(x[5] - x[2], 2);
  }
  double strain(std::span<const double> x) const { return 0.5 * (squared(x) / (L_ * L_) - 1); }
  double stiffness_, mass_per_length_, L_;
};

/// A swinging chain with a weight, of the project's bars or of the user's.
std::string chain(const std::string& element, const std::string& method) {
  return "  gravity: [0, 0, -9.81]\n  parts:\n    chain:\n      polyline: {points: [[0 m, 0 m, 0 m], [1 m, 0 "
         "m, 0.2 m]], "
         "divisions: 3}\n      " +
         element +
         "\n  point_masses:\n    - {nodes: chain.end, mass: 3 kg}\n  supports:\n    - {nodes: chain.start, "
         "fix: xyz}\n" +
         method;
}
const std::string own = "bar: {area: 10 mm^2, density: 7850 kg/m^3, youngs_modulus: 1 GPa, prestress: 10 Pa}",
                  users = "user_element: {name: bar, parameters: [1e4, 0.0785]}";

std::vector<double> displacement_after(const std::string& structure, double end) {
  Structure built(tests::scene(structure));
  built.output();
  const double step = built.step();
  for (double time = 0; time < end - 0.5 * step; time += step) built.integrator().advance(time, step);
  const auto u = built.integrator().displacement();
  return {u.begin(), u.end()};
}

void register_bar() {
  add_user_element("bar", [](std::span<const double> reference, const std::vector<double>& parameters) {
    return std::make_shared<Bar>(reference, parameters);
  });
}

}  // namespace

TEST_CASE("an element of a user moves as the project's own of the same energy, by every method") {
  register_bar();
  for (const std::string& method : {"  explicit: {}\n  step: 50 us\n", "  implicit: {}\n  step: 1 ms\n",
                                    "  start: {relaxation: {tolerance: 1e-9}}\n  step: 50 us\n"}) {
    CAPTURE(method);
    const auto a = displacement_after(chain(own, method), 0.2),
               b = displacement_after(chain(users, method), 0.2);
    REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      most = std::max(most, std::abs(a[i]));
      CHECK(b[i] == Approx(a[i]).margin(1e-6));
    }
    CHECK(most > 0.1);
  }
}

TEST_CASE("the stiffness that an element of a user does not say is the difference of its forces") {
  const std::vector<double> reference{0, 0, 0, 1, 0, 0}, x{0.1, 0, 0, 1.2, 0.3, -0.1};
  const Bar bar(reference, {1e4, 1});
  std::vector<double> K(36), ahead(6), behind(6), moved = x;
  bar.stiffness(x, K);
  for (std::size_t j = 0; j < 6; ++j) {
    moved[j] = x[j] + 1e-4;
    bar.force(moved, ahead);
    moved[j] = x[j] - 1e-4;
    bar.force(moved, behind);
    moved[j] = x[j];
    for (std::size_t i = 0; i < 6; ++i)
      CHECK(K[6 * i + j] ==
            Approx((ahead[i] - behind[i]) / 2e-4).margin(1e-3));  // of 1e4; cubic terms at 1e-4 m
  }
}

TEST_CASE("an element that the program does not have, or cannot make, is one sentence") {
  register_bar();
  CHECK_THAT(tests::complaint(chain("user_element: {name: baar}", "")),
             Catch::Contains("has no element 'baar'") && Catch::Contains("bar") &&
                 Catch::Contains("structure.parts.chain"));
  CHECK_THAT(tests::complaint(chain("user_element: {name: bar, parameters: [1]}", "")),
             Catch::Contains("user_element: "));
}
