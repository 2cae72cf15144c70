#include "tests/verification/effects/lean_particles.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dem_solver/collision/block_sweep.hpp"
#include "dem_solver/integration/leapfrog.hpp"

namespace talus::test {

using namespace dem;

LeanParticles::LeanParticles(const ParticleModel& model)
    : pairs_(model.pairs), step_(model.step), kick_(0.5 * model.step), skin_(model.skin) {
  spheres_.add(model.spheres, {});
}

void LeanParticles::step() {
  find_neighbours();
  sweep([this](Index block) { move(block); });
  watch_motion();
  kick_ = last_step_ = step_;
}

template <class Finish>
void LeanParticles::sweep(const Finish& finish) {
  const ContactStage stage = contact_stage();
  sweep_blocks(
      {pair_list_.block_count(), 1}, [&](Index block) { spheres_.clear_loads(pair_list_.places(block)); },
      [&](Index block) { contacts_.between_spheres(stage, block); }, finish);
}

void LeanParticles::move(Index block) {
  motion_ +=
      kick_and_drift(spheres_, pair_list_.places(block), {.gravity = {}, .step = step_, .kick = kick_});
}

void LeanParticles::watch_motion() {
  if (!motion_.finite) throw std::runtime_error("velocities overflow");
  approached_ += 2 * motion_.largest_speed * step_;
  motion_ = {};
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
          .step = last_step_};
}

void LeanParticles::find_neighbours() {
  if (listed_ && approached_ < skin_) return;
  if (listed_) approached_ = largest_approach();
  if (listed_ && approached_ < skin_) return;
  std::vector<Index> contacts(spheres_.position.size());
  pair_list_.count_contacts(contacts);
  const auto rebuilt = pair_list_.rebuild(spheres_, {.skin = skin_, .contacts = contacts});
  contacts_.rebuild(contact_stage(), {rebuilt.moves, {}, {}});
  place_ = spheres_.places();
  listed_position_ = spheres_.position;
  approached_ = 0;
  listed_ = true;
}

double LeanParticles::largest_approach() const noexcept {
  const auto moved = [this](Index i) {
    return triple<double>(spheres_.position[i]) - triple<double>(listed_position_[i]);
  };
  Triple<double> sum;
  for (Index i = 0; i < spheres_.size(); ++i) sum = sum + moved(i);
  const Triple<double> mean = (1.0 / spheres_.size()) * sum;
  double most = 0, second = 0;
  for (Index i = 0; i < spheres_.size(); ++i) {
    const Triple<double> own = moved(i) - mean;
    const double squared = dot(own, own);
    second = std::max(second, std::min(most, squared));
    most = std::max(most, squared);
  }
  return std::sqrt(most) + std::sqrt(second);
}

LeanParticlesAndWires::LeanParticlesAndWires(const ParticleModel& model) : LeanParticles(model) {
  boundary_ = model.boundary;
}

void LeanParticlesAndWires::step() {
  find_neighbours();
  sweep([](Index) {});
  contacts_.with_boundary(contact_stage());
  for (Index block = 0; block < pair_list_.block_count(); ++block) move(block);
  watch_motion();
}

void LeanParticlesAndWires::find_neighbours() {
  if (listed_) {
    if (approached_ + boundary_list_.boundary_motion(boundary_) < skin_) return;
    throw std::runtime_error("the first lists are used up");
  }
  const auto rebuilt = pair_list_.rebuild(spheres_, {.skin = skin_});
  const auto moves = boundary_list_.rebuild(boundary_, spheres_, rebuilt.new_place, 2 * skin_);
  contacts_.rebuild(contact_stage(), {rebuilt.moves, {}, moves});
  place_ = spheres_.places();
  listed_position_ = spheres_.position;
  listed_ = true;
}

}  // namespace talus::test
