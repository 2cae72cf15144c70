#include "dem_solver/integration/leapfrog.hpp"

#include <algorithm>
#include <atomic>

#include "core/parallel.hpp"

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

void raise(std::atomic<double>& largest, double value) noexcept {
  double before = largest.load();
  while (before < value && !largest.compare_exchange_weak(before, value)) {
  }
}

template <bool rotates, bool falls>
MotionSummary move_all(Spheres& spheres, const LeapfrogStep& how) noexcept {
  const StepRows by{.gravity = Lanes{how.gravity.x, how.gravity.y, how.gravity.z, 0} * how.kick,
                    .step = Lanes{how.step, how.step, how.step, 0},
                    .kick = Lanes{how.kick, how.kick, how.kick, 0}};
  std::atomic<double> speed_squared{0};
  std::atomic<bool> finite{true};
  core::parallel_runs({spheres.size(), how.threads}, [&](core::Block run) {
    const Extremes extremes = move_run<rotates, falls>(spheres, run, by);
    raise(speed_squared, extremes.speed_squared);
    if (!std::isfinite(extremes.sum)) finite = false;
  });
  return {.largest_speed = std::sqrt(speed_squared), .finite = finite};
}

}  // namespace

MotionSummary kick_and_drift(Spheres& spheres, const LeapfrogStep& how) noexcept {
  const bool falls = dot(how.gravity, how.gravity) > 0;
  if (spheres.rotates())
    return falls ? move_all<true, true>(spheres, how) : move_all<true, false>(spheres, how);
  return falls ? move_all<false, true>(spheres, how) : move_all<false, false>(spheres, how);
}

}  // namespace talus::dem
