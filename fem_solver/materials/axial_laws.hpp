#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fem_solver/elements/axial.hpp"

/// Axial laws with a memory of one number: force over length, for PathSegment.
namespace talus::fem {

/// What a law answers for a current length. Everything is a function of the length and the history alone.
struct AxialResponse {
  double force = 0;    ///< N; tension positive
  double slope = 0;    ///< dN/dl with the history following (N/m)
  double history = 0;  ///< to be kept if the state is accepted
};

/// Current and reference length of a segment.
struct SegmentLengths {
  double current, reference;  ///< m
};

/// Elastic rope, tension only: the cable of AxialElement in its length, with nothing to remember.
///
///     e = (l^2 - L^2)/(2 L^2)    S = E e + S_pre    N = A S l/L    U = A L (S^2 - S_pre^2)/(2 E)
///
/// S < 0 is slack: N = 0. Proven by (elements_axial_laws.cpp): "work done on a law with memory is stored or
/// dissipated".
struct ElasticRope {
  AxialSection section;

  static std::string called() { return "cables"; }
  using Lengths = SegmentLengths;
  AxialResponse respond(const Lengths& lengths, double history) const noexcept;
  double stored(const Lengths& lengths, double history) const noexcept;  ///< J
  double dissipated(const Lengths&, double) const noexcept { return 0; }
  /// Stored where it is slack (J).
  double slack_energy(double reference) const noexcept;
  double stiffest_slope(const Lengths& lengths, double force) const noexcept;  ///< N/m
};

/// Elastic-plastic rope, tension only. Source: one-dimensional return mapping, Simo and Hughes, Computational
/// Inelasticity, box 1.4, in Green-Lagrange strain and second Piola-Kirchhoff stress.
///
///     S = E (e - p) + S_pre, at most Y + H p
///     beyond it  dp = (S_trial - Y - H p)/(E + H),  dS/de = E H/(E + H)
///     N = A S l/L;  S < 0 is slack: N = 0
///     stored:     A L ((S^2 - S_pre^2)/(2 E) + H p^2/2)
///     dissipated: A L Y p
///
/// | symbol | variable         | meaning                                          | unit |
/// |--------|------------------|--------------------------------------------------|------|
/// | p      | history          | plastic strain, never falls                      | 1    |
/// | Y      | yield_stress     | first yield                                      | Pa   |
/// | H      | hardening        | slope of the yield stress over plastic strain    | Pa   |
/// | e      |                  | Green-Lagrange strain (l^2 - L^2)/(2 L^2)        | 1    |
///
/// Unloading is elastic; a rope that has yielded goes slack longer than it was. S_pre <= Y.
/// Proven by (elements_axial_laws.cpp): "work done on a law with memory is stored or dissipated".
struct ElasticPlasticRope {
  AxialSection section;
  double yield_stress = 0;
  double hardening = 0;

  static std::string called() { return "ropes that yield"; }
  using Lengths = SegmentLengths;
  AxialResponse respond(const Lengths& lengths, double history) const noexcept;
  double stored(const Lengths& lengths, double history) const noexcept;      ///< J
  double dissipated(const Lengths& lengths, double history) const noexcept;  ///< J
  double slack_energy(double reference) const noexcept;                      ///< J
  /// dN/dl of elastic loading at a force: what it may unload to in any step (N/m).
  double stiffest_slope(const Lengths& lengths, double force) const noexcept;
};

/// Rope brake: force over elongation from a table, plastic, with an end stop.
///
///     u = l - L     m = largest u so far
///     F = T(u) + stop(u)                               u >= m: the brake runs
///     F = max(0, T(m) - k0 (m - u)) + stop(u)          u < m:  unloads and reloads at the initial stiffness
///     stop(u) = ks b^2/(2 w) for 0 < b < w,  ks (b - w/2) beyond;   b = u - u_end
///     stored: F_plastic^2/(2 k0) + integral of stop       dissipated: integral_0^m T du - T(m)^2/(2 k0)
///
/// | symbol | variable        | meaning                                                            | unit |
/// |--------|-----------------|--------------------------------------------------------------------|------|
/// | T      | table           | force over elongation, from (0, 0), linear between points,         | N    |
/// |        |                 | constant after the last one                                        |      |
/// | k0     |                 | slope of the table's first piece, the steepest of all              | N/m  |
/// | m      | history         | largest elongation, never falls                                    | m    |
/// | u_end  |                 | elongation of the table's last point: the end of travel            | m    |
/// | ks     | stop_stiffness  | elastic stiffness past the end of travel                           | N/m  |
/// | w      | stop_width      | over which the stop comes in                                       | m    |
///
/// A brake does not push: F >= 0. The slope of T never exceeds k0, so m alone tells how far the brake has
/// run. Proven by (elements_axial_laws.cpp): "work done on a law with memory is stored or dissipated", "a
/// brake ...".
class BrakeLaw {
 public:
  struct Description {
    std::vector<std::pair<double, double>>
        table;                  ///< elongation (m), force (N); elongations rise from above 0
    double stop_stiffness = 0;  ///< N/m
    double stop_width = 0;      ///< m
  };
  /// @throws core::ConfigError naming the point that is out of order, not positive or steeper than the first
  /// piece
  explicit BrakeLaw(Description description);

  static std::string called() { return "brakes"; }
  using Lengths = SegmentLengths;
  AxialResponse respond(const Lengths& lengths, double history) const noexcept;
  double stored(const Lengths& lengths, double history) const noexcept;      ///< J
  double dissipated(const Lengths& lengths, double history) const noexcept;  ///< J

  static double slack_energy(double /*reference*/) noexcept { return 0; }  ///< J

  double stiffest_slope(const Lengths& lengths, double force) const noexcept;  ///< N/m

  double travel() const noexcept { return description_.table.back().first; }  ///< m, up to the end stop
  double initial_stiffness() const noexcept { return initial_stiffness_; }

 private:
  struct Point {
    double force, slope;  ///< N, N/m
  };
  Point table_at(double elongation) const noexcept;
  Point stop_at(double elongation) const noexcept;
  Point plastic_at(double elongation, double largest) const noexcept;
  double table_work(double elongation) const noexcept;  ///< J

  Description description_;
  double initial_stiffness_ = 0;
  std::vector<double> work_;  ///< of the table up to each point
};

/// What a segment bears; what is not given does not count.
struct BreakingLimits {
  double force = std::numeric_limits<double>::infinity();   ///< N
  double strain = std::numeric_limits<double>::infinity();  ///< change of length over reference length
  double work = std::numeric_limits<double>::infinity();    ///< J; stored since slack, and dissipated
};

/// A law that breaks: the first step that ends beyond a limit is the last one in which the segment pulls. What it
/// stored is dissipated then, so that stored + dissipated goes on without a jump.
///
///     history >= 0: the law's own      history < 0: broken, minus what it has dissipated on the whole (J)
///
/// Proven by (elements_axial_laws.cpp): "work done on a law with memory is stored or dissipated", "a segment breaks at
/// its force, strain or work, and pulls no more".
template <class Law>
struct Breaking {
  Law law;
  BreakingLimits limits;

  using Lengths = SegmentLengths;
  static std::string called() { return "breaking " + Law::called(); }
  static bool is_broken(double history) noexcept { return history < 0; }

  AxialResponse respond(const Lengths& lengths, double history) const noexcept {
    if (is_broken(history)) return {0, 0, history};
    AxialResponse response = law.respond(lengths, history);
    const double lost = law.stored(lengths, response.history) + law.dissipated(lengths, response.history) -
                        law.slack_energy(lengths.reference);
    if (response.force > limits.force || lengths.current > (1 + limits.strain) * lengths.reference ||
        lost > limits.work)
      response.history = -std::max(lost, std::numeric_limits<double>::min());
    return response;
  }
  double stored(const Lengths& lengths, double history) const noexcept {
    return is_broken(history) ? law.slack_energy(lengths.reference) : law.stored(lengths, history);
  }
  double dissipated(const Lengths& lengths, double history) const noexcept {
    return is_broken(history) ? -history : law.dissipated(lengths, history);
  }
  double stiffest_slope(const Lengths& lengths, double force) const noexcept {
    return law.stiffest_slope(lengths, force);
  }
};

}  // namespace talus::fem
