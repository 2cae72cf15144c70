#pragma once

#include <algorithm>
#include <cmath>

#include "fem_solver/elements/axial.hpp"

namespace talus::fem {

/// Tension of a rope as a function of its stretch, for ropes whose material moves between segments: what
/// counts is current over unstretched length. Source: [P eq. 3] with l/L = q.
///
///     e = (q^2 - 1)/2      S = E e + S_pre      N = A S q      dN/dq = A (S + E q^2)
///     U per unstretched length = A (E e^2/2 + S_pre e)
///
/// | symbol | variable  | meaning                                                             | unit |
/// |--------|-----------|---------------------------------------------------------------------|------|
/// | q      | stretch   | current length over unstretched length                              | 1    |
/// | S      |           | second Piola-Kirchhoff stress; never negative, a rope goes slack    | Pa   |
/// | N      | tension   | force along the rope                                                | N    |
/// | q_0    | slack_stretch | stretch without tension, sqrt(1 - 2 S_pre/E); 0 for S_pre > E/2 | 1    |
///
/// Below q_0: N = 0, U at its minimum -A S_pre^2/(2 E). Valid for every q > 0.
/// Proven by (elements_sliding.cpp): "the tension of a rope is the derivative of its energy".
class RopeLaw {
 public:
  explicit RopeLaw(const AxialSection& section)
      : section_(section),
        slack_stretch_(std::sqrt(std::max(0.0, 1 - 2 * section.prestress / section.youngs_modulus))) {}

  double stress(double stretch) const noexcept {
    return std::max(0.0, section_.youngs_modulus * strain(stretch) + section_.prestress);
  }
  double tension(double stretch) const noexcept { return section_.area * stress(stretch) * stretch; }
  /// dN/dq; 0 where slack.
  double tension_slope(double stretch) const noexcept {
    return stretch <= slack_stretch_ ? 0 : taut_slope(stretch);
  }
  /// dN/dq as if the rope were taut.
  double taut_slope(double stretch) const noexcept {
    return section_.area * (stress(stretch) + section_.youngs_modulus * stretch * stretch);
  }
  double energy_per_length(double stretch) const noexcept {
    const double E = section_.youngs_modulus, S_pre = section_.prestress,
                 e = strain(std::max(stretch, slack_stretch_));
    return section_.area * (0.5 * E * e * e + S_pre * e);
  }
  /// q N - u, the force with which a stretched segment takes in more material: what its energy falls by for each
  /// metre (N).
  double pull_of_material(double stretch) const noexcept {
    return stretch * tension(stretch) - energy_per_length(stretch);
  }
  double slack_stretch() const noexcept { return slack_stretch_; }
  /// The stretch q at a tension (N) above 0, by Newton's method on N(q) = (A E/2) q (q^2 - q_0^2), which is convex:
  /// no step but the first passes the root. @param guess any stretch above 0; near the answer two steps do
  double stretch_at(double tension, double guess) const noexcept {
    const double half = 0.5 * section_.area * section_.youngs_modulus,
                 offset = 2 * section_.prestress / section_.youngs_modulus - 1;  // -q_0^2 where q_0 > 0
    const double q0 = slack_stretch_;
    double x = std::max(0.0, guess - q0);  // q - q_0
    for (int step = 0; step < 100; ++step) {
      const double q = q0 + x, square = offset < 0 ? x * (2 * q0 + x) : x * x + offset;  // q^2 - q_0^2
      const double change = (half * q * square - tension) / (half * (square + 2 * q * q));
      x -= change;
      if (std::abs(change) <= 1e-9 * x) break;  // what is left is the square of that
    }
    return q0 + x;
  }
  const AxialSection& section() const noexcept { return section_; }

 private:
  static double strain(double stretch) noexcept { return 0.5 * (stretch * stretch - 1); }

  AxialSection section_;
  double slack_stretch_;
};

}  // namespace talus::fem
