#include "tests/verification/effects/lean_particles.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dem_solver/collision/size_classes.hpp"
#include "dem_solver/integration/leapfrog.hpp"

namespace talus::test {

using namespace dem;

LeanParticles::LeanParticles(const ParticleModel& model) : pairs_(model.pairs), step_(model.step) {
  spheres_.add(model.spheres, false);
  skin_ = 0.2 * 0.5 * SizeClasses(spheres_, 0).main_cell();
}

void LeanParticles::step() {
  find_neighbours();
  for (Index i = 0; i < spheres_.size(); ++i) spheres_.force[i] = {};
  contacts_.evaluate(contact_stage());
  const MotionSummary motion = kick_and_drift(spheres_, {.gravity = {}, .step = step_, .kick = step_});
  if (!motion.finite) throw std::runtime_error("velocities overflow");
  travelled_ += motion.largest_speed * step_;
}

ContactStage LeanParticles::contact_stage() {
  return {.spheres = spheres_,
          .rocks = rocks_,
          .place = place_,
          .planes = {},
          .boundary = boundary_,
          .pair_list = pair_list_,
          .plane_list = plane_list_,
          .boundary_list = boundary_list_,
          .table = pairs_,
          .step = step_};
}

void LeanParticles::find_neighbours() {
  if (listed_ && 2 * travelled_ < skin_) return;
  if (listed_) travelled_ = largest_motion();
  if (listed_ && 2 * travelled_ < skin_) return;
  const auto rebuilt = pair_list_.rebuild(spheres_, skin_, 1);
  contacts_.rebuild(contact_stage(), {rebuilt.moves, {}, {}});
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

}  // namespace talus::test
