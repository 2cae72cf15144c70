#pragma once

#include <string>
#include <vector>

#include "fem_solver/materials/axial_laws.hpp"

/// What a ring of wire answers to being pulled out of round.
namespace talus::fem {

/// Tension along a ring over the perimeter of the polygon through the points where it is held: bending, then stretch.
///
///     p = sum of the polygon's sides      u = p - p_0      m = largest u so far
///     T(u) = N_k u/(p_k - p_0)                 p <= p_k: what is round turns straight
///     T(u) = N_k + k (p - p_k)                 p >  p_k: what is straight is drawn taut; k = (N_b - N_k)/(p_b - p_k)
///     N = T(u)                                 u >= m
///     N = max(0, T(m) - k_w (m - u))           u < m;  k_w = N_b/(0.004 p_b), the stretch of the wire itself
///     stored: N^2/(2 k_w)    dissipated: integral_0^m T du - T(m)^2/(2 k_w)
///
/// | symbol   | variable           | meaning                                                     | unit |
/// |----------|--------------------|-------------------------------------------------------------|------|
/// | p        | lengths.current    | perimeter of the polygon; wire slides through its corners   | m    |
/// | p_0      | lengths.reference  | of the round ring: shorter for fewer corners                | m    |
/// | p_k, N_k | straight           | where bending ends and stretch begins                       | m, N |
/// | p_b, N_b | breaking           | where the ring breaks, if it may                            | m, N |
/// | m        | history            | largest growth of the perimeter, never falls                | m    |
///
/// A ring is straight when the polygon is as long as its wire, however many corners it has: p_k and p_b are those of a
/// chain, with two. Turning what is round to corners and straight sides is plastic to the end (the wire's own stretch
/// is a tenth of p_b - p_k): only that comes back, an assumption no test of a chain speaks of. A ring does not push.
/// Valid for p_0 < p_k; beyond p_b the stretch goes on.
/// Proven by (elements_axial_laws.cpp): "work done on a law with memory is stored or dissipated".
class RingLaw {
 public:
  struct Point {
    double perimeter = 0;  ///< m
    double tension = 0;    ///< N
  };
  /// @pre 0 < straight < breaking in both
  RingLaw(const Point& straight, const Point& breaking) noexcept : straight_(straight), breaking_(breaking) {}

  static std::string called() { return "rings"; }
  using Lengths = SegmentLengths;
  AxialResponse respond(const Lengths& lengths, double history) const noexcept;
  double stored(const Lengths& lengths, double history) const noexcept;      ///< J
  double dissipated(const Lengths& lengths, double history) const noexcept;  ///< J

  static double slack_energy(double /*reference*/) noexcept { return 0; }  ///< J
  /// What a ring may unload with in any step (N/m).
  double stiffest_slope(const Lengths& lengths, double force) const noexcept;

  const Point& straight() const noexcept { return straight_; }
  const Point& breaking() const noexcept { return breaking_; }

 private:
  struct Loading {
    double force, slope, work;  ///< N, N/m, J
  };
  Loading load(double growth, double reference) const noexcept;
  /// k_w, or the slope of a branch that is steeper.
  double unloading_slope(double reference) const noexcept;

  Point straight_, breaking_;
};

/// Wire wound to a ring.
struct RingDescription {
  int windings = 0;
  double wire_diameter = 0;   ///< m
  double inner_diameter = 0;  ///< m
  double strength = 0;        ///< Pa, of the wire
};

/// A chain of three rings pulled until one breaks.
struct RingChainTest {
  int windings;
  double force;       ///< N, at which it breaks
  double elongation;  ///< m, then
};
/// The tests that ring_law() is calibrated on: rings of 3 mm wire, 0.3 m wide. At 85 % of the elongation each had 15 %
/// of the force. Source: published tests of three-ring chains, as docs/nets.md lists them.
const std::vector<RingChainTest>& ring_chain_tests();

/// The law of a ring, from those tests. In a chain of three the perimeter of each ring is twice a third of the chain,
/// and its tension half of the chain's force. Force over windings and elongation are interpolated linearly in 1/n
/// (which makes the force linear in n) and held beyond the tests' n. Tensions are in proportion to the wire's section
/// and strength, perimeters to the ring's diameter.
RingLaw ring_law(const RingDescription& ring);

}  // namespace talus::fem
