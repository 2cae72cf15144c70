#include "dem_solver/integration/leapfrog.hpp"

#include <algorithm>
#include <cmath>

namespace talus::dem {

namespace {

struct Extremes {
  double speed_squared = 0;
  double sum = 0;  ///< of squared speeds; only to see what is not a number
};

struct StepRows {
  Lanes gravity;     ///< m/s; velocity gained in a step
  Lanes step, kick;  ///< s, s, s, 0: the fourth component of a row does not move
};

template <bool rotates, bool falls>
TALUS_INLINE void move_sphere(Spheres& s, Index i, const StepRows& by, Extremes& extremes) noexcept {
  const double mass = s.velocity[i].w, radius = s.position[i].w;
  Lanes gained = load(s.force[i]) * (by.kick / mass);
  if constexpr (falls) gained += by.gravity;
  const Lanes velocity = load(s.velocity[i]) + gained;
  store(s.velocity[i], velocity);
  store(s.position[i], load(s.position[i]) + velocity * by.step);
  if constexpr (rotates)
    store(s.spin[i], load(s.spin[i]) + load(s.torque[i]) * (by.kick / (0.4 * mass * radius * radius)));
  const double squared = velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2];
  extremes.speed_squared = std::max(extremes.speed_squared, squared);
  extremes.sum += squared;
}

template <bool rotates, bool falls>
Extremes move_run(Spheres& spheres, core::Block run, const StepRows& by) noexcept {
  const bool has_rocks = !spheres.rock.empty();
  Extremes extremes;
  for (auto i = static_cast<Index>(run.begin); i < run.end; ++i)
    if (!has_rocks || spheres.rock[i] < 0) move_sphere<rotates, falls>(spheres, i, by, extremes);
  return extremes;
}

template <bool rotates, bool falls>
MotionSummary summary_of_run(Spheres& spheres, core::Block run, const LeapfrogStep& how) noexcept {
  const StepRows by{.gravity = Lanes{how.gravity.x, how.gravity.y, how.gravity.z, 0} * how.kick,
                    .step = Lanes{how.step, how.step, how.step, 0},
                    .kick = Lanes{how.kick, how.kick, how.kick, 0}};
  const Extremes extremes = move_run<rotates, falls>(spheres, run, by);
  return {.largest_speed = std::sqrt(extremes.speed_squared), .finite = std::isfinite(extremes.sum)};
}

}  // namespace

MotionSummary kick_and_drift(Spheres& spheres, core::Block run, const LeapfrogStep& how) noexcept {
  const bool falls = dot(how.gravity, how.gravity) > 0;
  if (spheres.rotates())
    return falls ? summary_of_run<true, true>(spheres, run, how)
                 : summary_of_run<true, false>(spheres, run, how);
  return falls ? summary_of_run<false, true>(spheres, run, how)
               : summary_of_run<false, false>(spheres, run, how);
}

}  // namespace talus::dem
