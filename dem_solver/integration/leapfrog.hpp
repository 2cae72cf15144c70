#pragma once

#include <algorithm>

#include "core/parallel.hpp"
#include "dem_solver/particles/spheres.hpp"

namespace talus::dem {

struct LeapfrogStep {
  Triple<double> gravity;  ///< m/s^2
  double step = 0;         ///< s; from the present positions to the next
  double kick = 0;         ///< s; from the middle of the last step to the middle of this one
};

/// m^2/s^2; what v.v_before has to be diminished by where the step before was shorter, to be the product at
/// the time of the forces all the same: (h_2 - h_1)/2 a.v with v at that time. Zero in steps of one length.
/// @param velocity after the step (m/s), `acceleration` in it (m/s^2)
inline double product_of_unequal_steps(const LeapfrogStep& last, const Triple<double>& velocity,
                                       const Triple<double>& acceleration) noexcept {
  return (last.step - last.kick) * dot(acceleration, velocity - (0.5 * last.step) * acceleration);
}

/// What a step tells about the motion as a whole.
struct MotionSummary {
  double largest_speed = 0;  ///< m/s
  bool finite = true;        ///< every position and velocity is a number

  MotionSummary& operator+=(const MotionSummary& other) noexcept {
    largest_speed = std::max(largest_speed, other.largest_speed);
    finite = finite && other.finite;
    return *this;
  }
};

/// Moves the spheres of a run of places, except for parts of rocks, by one step of the leapfrog (symplectic Euler), second order
/// in time:
///     v_{n+1/2} = v_{n-1/2} + (F(x_n)/m + g) kick      x_{n+1} = x_n + v_{n+1/2} step
///     w_{n+1/2} = w_{n-1/2} + T(x_n)/I kick            I = 2/5 m R^2
///     kick = (step_before + step)/2
/// The scene's velocity belongs to time 0, so the first kick is step/2 long, and free fall is the parabola exactly. Stable for step < 2 sqrt(m/k). Test: "Free fall is the parabola
/// to round-off", "Free fall is exact
/// in steps of changing length".
MotionSummary kick_and_drift(Spheres& spheres, core::Block run, const LeapfrogStep& how) noexcept;

}  // namespace talus::dem
