#include "dem_solver/integration/leapfrog.hpp"

#include <algorithm>

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

TALUS_INLINE void move_sphere(Spheres& s, Index i, const StepRows& by, Extremes& extremes) noexcept {
  const double mass = s.velocity[i].w, radius = s.position[i].w;
  const Lanes velocity = load(s.velocity[i]) + (load(s.force[i]) * (by.kick / mass) + by.gravity);
  store(s.velocity[i], velocity);
  store(s.position[i], load(s.position[i]) + velocity * by.step);
  if (s.rotates())
    store(s.spin[i], load(s.spin[i]) + load(s.torque[i]) * (by.kick / (0.4 * mass * radius * radius)));
  const double squared = velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2];
  extremes.speed_squared = std::max(extremes.speed_squared, squared);
  extremes.sum += squared;
}

}  // namespace

MotionSummary kick_and_drift(Spheres& spheres, const LeapfrogStep& how) noexcept {
  const StepRows by{.gravity = Lanes{how.gravity.x, how.gravity.y, how.gravity.z, 0} * how.kick,
                    .step = Lanes{how.step, how.step, how.step, 0},
                    .kick = Lanes{how.kick, how.kick, how.kick, 0}};
  double speed_squared = 0, sum = 0;
  const Index count = spheres.size();
  const bool has_rocks = !spheres.rock.empty();
#pragma omp parallel for schedule(static) num_threads(how.threads) if (how.threads > 1) reduction(max : speed_squared) reduction(+ : sum)
  for (Index i = 0; i < count; ++i) {
    if (has_rocks && spheres.rock[i] >= 0) continue;
    Extremes extremes;
    move_sphere(spheres, i, by, extremes);
    speed_squared = std::max(speed_squared, extremes.speed_squared);
    sum += extremes.sum;
  }
  return {.largest_speed = std::sqrt(speed_squared), .finite = std::isfinite(sum)};
}

}  // namespace talus::dem
