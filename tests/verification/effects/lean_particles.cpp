#include "tests/verification/effects/lean_particles.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dem_solver/collision/size_classes.hpp"

namespace talus::test {

using namespace dem;

LeanParticles::LeanParticles(const ParticleModel& model) : pairs_(model.pairs), step_(model.step) {
  spheres_.add(model.spheres, false);
  skin_ = 0.2 * 0.5 * SizeClasses(spheres_, 0).main_cell();
}

void LeanParticles::step() {
  find_neighbours();
  std::ranges::fill(spheres_.force, Row{});
  contacts_.evaluate({spheres_, pair_list_, pairs_, step_, 1});
  travelled_ += move_spheres() * step_;
}

void LeanParticles::find_neighbours() {
  if (listed_ && 2 * travelled_ < skin_) return;
  if (listed_) travelled_ = largest_motion();
  if (listed_ && 2 * travelled_ < skin_) return;
  contacts_.rebuild(pair_list_, pair_list_.rebuild(spheres_, skin_, 1).moves);
  place_ = spheres_.places();
  listed_position_ = spheres_.position;
  travelled_ = 0;
  listed_ = true;
}

double LeanParticles::largest_motion() const noexcept {
  double largest = 0;
  for (Index i = 0; i < spheres_.size(); ++i) {
    const Triple<double> moved = triple<double>(spheres_.position[i]) - triple<double>(listed_position_[i]);
    largest = std::max(largest, dot(moved, moved));
  }
  return std::sqrt(largest);
}

double LeanParticles::move_spheres() noexcept {
  const Lanes step{step_, step_, step_, 0};
  double speed_squared = 0, sum = 0;
  for (Index i = 0; i < spheres_.size(); ++i) {
    const Lanes velocity =
        load(spheres_.velocity[i]) + load(spheres_.force[i]) * (step / spheres_.velocity[i].w);
    store(spheres_.velocity[i], velocity);
    store(spheres_.position[i], load(spheres_.position[i]) + velocity * step);
    const double squared = velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2];
    speed_squared = std::max(speed_squared, squared);
    sum += squared;
  }
  if (!std::isfinite(sum)) throw std::runtime_error("velocities overflow");
  return std::sqrt(speed_squared);
}

}  // namespace talus::test
