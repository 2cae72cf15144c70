// A structural solver with an element of its own: a rubber cord that stiffens, N = k u + h u^3 with u = l - L.
//
//     build/release/bin/rubber_solver configs/examples/rubber_cord.yaml
//
// In a coupled scene the structure names it: structure: {solver: rubber_solver, ...}
#include <cmath>
#include <stdexcept>

#include "fem_solver/app/program.hpp"
#include "fem_solver/elements/user_element.hpp"

namespace {

class RubberCord final : public talus::fem::UserElement {
 public:
  /// @param parameters k (N/m), h (N/m^3), mass per length (kg/m)
  RubberCord(std::span<const double> reference, const std::vector<double>& parameters) {
    if (parameters.size() != 3)
      throw std::invalid_argument("a rubber cord has the parameters k, h and mass per length");
    linear_ = parameters[0];
    cubic_ = parameters[1];
    length_ = length_of(reference);
    mass_ = parameters[2] * length_;
  }

  double energy(std::span<const double> x) const override {
    const double u = stretch(x);
    return 0.5 * linear_ * u * u + 0.25 * cubic_ * u * u * u * u;
  }
  void force(std::span<const double> x, std::span<double> force) const override {
    const double u = stretch(x), pull = linear_ * u + cubic_ * u * u * u, l = length_of(x);
    for (std::size_t c = 0; c < 3; ++c) {
      force[3 + c] = pull * (x[3 + c] - x[c]) / l;
      force[c] = -force[3 + c];
    }
  }
  void masses(std::span<double> masses) const override { masses[0] = masses[1] = 0.5 * mass_; }

 private:
  static double length_of(std::span<const double> x) {
    return std::hypot(x[3] - x[0], x[4] - x[1], x[5] - x[2]);
  }
  /// Slack where it is shorter than it was made.
  double stretch(std::span<const double> x) const { return std::max(0.0, length_of(x) - length_); }

  double linear_ = 0, cubic_ = 0, length_ = 0, mass_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  talus::fem::add_user_element("rubber_cord",
                               [](std::span<const double> reference, const std::vector<double>& parameters) {
                                 return std::make_shared<RubberCord>(reference, parameters);
                               });
  return talus::fem::run_program(argc, argv);
}
