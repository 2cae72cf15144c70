#pragma once

#include <vector>

#include "dem_solver/solver.hpp"
#include "tests/verification/effects/counting.hpp"

namespace talus::test {

/// The particle solver as it would be if it knew spheres with Hertz contacts and nothing else: no gravity,
/// planes, boundary, rocks, rotation, friction, gates, ledger. Composed of the same kernels; the contact model's
/// lists of planes and boundaries are empty.
class LeanParticles : public Stepper {
 public:
  explicit LeanParticles(const dem::ParticleModel& model);
  void step() override;

 protected:
  dem::ContactStage contact_stage();
  virtual void find_neighbours();
  /// Loads between spheres; finish(block) follows when a block has all of its own.
  template <class Finish>
  void sweep(const Finish& finish);
  void move(dem::Index block);
  void watch_motion();
  double largest_approach() const noexcept;

  dem::Spheres spheres_;
  dem::PairTable pairs_;
  double step_ = 0, last_step_ = 0, kick_ = 0, skin_ = 0, approached_ = 0;
  dem::PairList pair_list_;
  dem::PlaneList plane_list_;
  dem::Boundary boundary_;
  dem::BoundaryList boundary_list_;
  dem::Rocks rocks_;
  dem::ContactModel<dem::ContactLaw<dem::Hertz, dem::NoTerm, dem::NoTerm, dem::NoTerm>> contacts_;
  std::vector<dem::Index> place_;
  std::vector<dem::Row> listed_position_;
  dem::MotionSummary motion_;
  bool listed_ = false;
};

/// The same with a boundary of wires whose contacts are explicit, for as many steps as its first lists serve.
class LeanParticlesAndWires final : public LeanParticles {
 public:
  explicit LeanParticlesAndWires(const dem::ParticleModel& model);
  void step() override;

 private:
  void find_neighbours() override;
};

}  // namespace talus::test
