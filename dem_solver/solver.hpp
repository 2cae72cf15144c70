#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/output/source.hpp"
#include "core/program/stage_clock.hpp"
#include "dem_solver/boundary/boundary.hpp"
#include "dem_solver/boundary/planes.hpp"
#include "dem_solver/collision/pair_list.hpp"
#include "dem_solver/contact/materials.hpp"
#include "dem_solver/integration/leapfrog.hpp"
#include "dem_solver/output/gates.hpp"
#include "dem_solver/rocks/rocks.hpp"
#include "dem_solver/scene/contact_models.hpp"

namespace talus::dem {

/// What is to be simulated.
struct ParticleModel {
  std::vector<SphereInput> spheres;
  std::vector<RockInput> rocks;  ///< spheres with `rock` k belong to rocks[k]
  std::vector<mesh::Surface>
      rock_surfaces;              ///< for pictures; empty ones where there is none; in principal axes
  std::vector<core::Fact> facts;  ///< of rocks that were filled with spheres, for the summary
  std::vector<Plane> planes;
  Boundary boundary;
  PairTable pairs;
  LawChoice law;
  Triple<double> gravity;                                       ///< m/s^2
  double step = 0;                                              ///< s
  ContactRule contact_rule = ContactRule::local_minima;         ///< with the boundary
  std::optional<ImplicitVelocities::Control> implicit_contact;  ///< with the boundary; absent: explicit
  double skin = 0;  ///< m; of the neighbour lists; 0: follows from how fast the spheres move
  int threads = 1;
  std::vector<Gate> gates;
  bool may_be_unstable =
      false;  ///< whether to go on with a rock on more contacts than the step is short enough for
};

/// Stages of a step whose time is told apart where the scene asks for it.
enum StepStage : std::size_t { search, between_spheres, with_planes, with_boundary, motion };
inline core::StageClock make_stage_clock() {
  return {"particles",
          {"search_for_neighbours", "contacts_between_spheres", "contacts_with_planes",
           "contacts_with_the_boundary", "motion"}};
}

/// Energies at the time level of the forces, t_{n-1} after n steps: the one at which leapfrog energies are
/// defined (J).
struct ParticleLedger {
  double kinetic = 0;   ///< sum of 1/2 m v_{n-3/2}.v_{n-1/2}
  double rotation = 0;  ///< the same of spins
  double elastic = 0;   ///< contact springs
  double damping = 0;   ///< dissipated by normal dashpots since the start
  double friction = 0;  ///< dissipated by friction and rolling resistance since the start
  double gravity = 0;   ///< work of gravity since the start
  double boundary = 0;  ///< work of moving boundaries since the start

  /// What was not there at the start and was not supplied; constant for an exact integration.
  double balance() const noexcept {
    return kinetic + rotation + elastic + damping + friction - gravity - boundary;
  }
};

/// The particle solver: spheres that meet each other, planes and a boundary. A copy of it is a saved state:
/// it continues with the same bits.
class ParticleSolver {
 public:
  explicit ParticleSolver(ParticleModel model);
  // Compiled once: they go through every contact law.
  ParticleSolver(const ParticleSolver& other);
  ParticleSolver(ParticleSolver&& other) noexcept;
  ParticleSolver& operator=(const ParticleSolver& other);
  ParticleSolver& operator=(ParticleSolver&& other) noexcept;
  ~ParticleSolver();

  /// Advances by one step. Forces are those of the positions at the start of the step, of spheres and
  /// boundary alike.
  /// @throws NumericalError when a position or velocity is no longer a number.
  void step();

  std::int64_t steps_done() const noexcept { return steps_done_; }
  double step_length() const noexcept { return step_; }
  /// s; counted from the last set_clock(), never accumulated.
  double time() const noexcept {
    return clock_time_ + static_cast<double>(steps_done_ - clock_steps_) * step_;
  }
  struct Clock {
    double time = 0;  ///< s; now
    double step = 0;  ///< s; of the steps to come
  };
  void set_clock(const Clock& clock) noexcept;
  /// From here on steps add their time to the stages of this clock, StepStage. @pre it outlives the solver
  void measure_stages(core::StageClock& clock) noexcept { stage_clock_ = &clock; }

  /// For who moves the boundary by other ways between two steps than its velocities say: the work (J) that the
  /// present reactions do on what is missing, to the ledger.
  void book_boundary_work(double on_particles) noexcept { work_.boundary += on_particles; }

  const Spheres& spheres() const noexcept { return spheres_; }
  const Rocks& rocks() const noexcept { return rocks_; }
  const Gates& gates() const noexcept { return gates_; }
  /// Where the sphere that was added as number id stands now.
  Index place(Index id) const noexcept { return place_[id]; }
  Boundary& boundary() noexcept { return boundary_; }
  const Boundary& boundary() const noexcept { return boundary_; }
  const BoundaryList& boundary_list() const noexcept { return boundary_list_; }
  const PairList& pair_list() const noexcept { return pair_list_; }
  const LawChoice& law() const noexcept { return law_; }
  /// How often the neighbour lists were built.
  std::int64_t searches() const noexcept { return searches_; }
  /// Of implicit contact: sweeps of all steps so far, and steps whose sweeps did not converge.
  std::int64_t sweeps() const noexcept { return sweeps_; }
  std::int64_t unconverged_steps() const noexcept { return unconverged_steps_; }

  /// @pre the model's law has a ledger
  ParticleLedger ledger() const;

  /// Calls visit(name, value) for every array and number of the state, for checkpoints.
  template <class Self, class Visitor>
  static void visit_state(Self& self, const Visitor& visit);
  /// To be called after visit_state() has replaced the state: sizes what is derived from it.
  void fit_to_state();

 private:
  /// Bounds of how far spheres have moved since the lists were built, m.
  struct Motion {
    double alone = 0;            ///< of any sphere
    double towards_another = 0;  ///< of any two towards each other
  };
  void find_neighbours();
  bool lists_are_used_up() noexcept;
  Motion measured_motion() const noexcept;
  double next_skin() const noexcept;
  /// m; of the lists of planes and boundary, towards which all spheres may move together.
  double wall_skin() const noexcept { return 2 * skin_; }
  /// Whether a sphere's loads are known as soon as its block and the two beside it have interacted. (Stages
  /// whose time is to be told apart have to follow each other.)
  bool loads_end_with_blocks() const noexcept;
  // Two ways to the same bits: all stages of a block while the caches hold it, or one stage after the other.
  void advance_block_by_block() noexcept;
  void advance_stage_by_stage() noexcept;
  void meet_each_other(const ContactStage& stage, Index block) noexcept;
  void meet_planes(const ContactStage& stage, Index block) noexcept;
  void meet_boundary(const ContactStage& stage) noexcept;
  void move_block(Index block) noexcept;
  void move_rocks() noexcept;
  void watch_motion();
  void watch_rocks() const;
  [[noreturn]] void report_not_finite() const;
  ContactStage contact_stage() noexcept;
  double gravity_work_level() const noexcept;
  /// s; none before the first: the velocity at the start belongs to the time of the start
  double last_step() const noexcept { return previous_step_; }
  LeapfrogStep this_leap() const noexcept { return {gravity_, step_, kick_}; }
  LeapfrogStep last_leap() const noexcept;
  void add_spheres_to(ParticleLedger& ledger) const noexcept;
  double stored_energy() const;  ///< J; in contacts at the time level of the forces

  Spheres spheres_;
  Rocks rocks_;
  std::vector<Plane> planes_;
  Boundary boundary_;
  PairTable pairs_;
  LawChoice law_;
  Triple<double> gravity_;
  double step_ = 0;           ///< s; of the step to come
  double previous_step_ = 0;  ///< s; 0 before the first
  double kick_ = 0;           ///< s; of the last step
  double skin_ = 0;           ///< m; of the list of pairs
  double main_radius_ = 0;    ///< m; of the most frequent size class; 0: the skin is given
  std::optional<ImplicitContact> implicit_contact_;
  ContactRule contact_rule_ = ContactRule::local_minima;
  int threads_ = 1;
  bool may_be_unstable_ = false;

  PairList pair_list_;
  PlaneList plane_list_;
  BoundaryList boundary_list_;
  AnyContactModel contacts_;
  std::vector<Index> place_;
  std::vector<Row> listed_position_;  ///< of the spheres when the lists were built
  Motion moved_;
  std::vector<MotionSummary> block_motion_{1};  ///< in this step
  bool listed_ = false;
  std::int64_t listed_at_ = 0;  ///< step
  std::int64_t steps_done_ = 0;
  double clock_time_ = 0;
  std::int64_t clock_steps_ = 0;
  core::StageClock* stage_clock_ = nullptr;  ///< of the stages; nullptr: nobody asks
  std::int64_t searches_ = 0;
  std::int64_t sweeps_ = 0, unconverged_steps_ = 0;
  ContactWork work_;
  Gates gates_;
  double gravity_level_at_start_ = 0;
};

template <class Self, class Visitor>
void ParticleSolver::visit_state(Self& self, const Visitor& visit) {
  const auto part = [&visit](std::string prefix) {
    return [&visit, prefix = prefix + "."](const std::string& name, auto& value) {
      visit(prefix + name, value);
    };
  };
  Spheres::visit_state(self.spheres_, part("spheres"));
  Rocks::visit_state(self.rocks_, part("rocks"));
  Boundary::visit_state(self.boundary_, part("boundary"));
  PairList::visit_state(self.pair_list_, part("pair_list"));
  PlaneList::visit_state(self.plane_list_, part("plane_list"));
  BoundaryList::visit_state(self.boundary_list_, part("boundary_list"));
  Gates::visit_state(self.gates_, part("gates"));
  std::visit([&](auto& model) { std::decay_t<decltype(model)>::visit_state(model, part("contacts")); },
             self.contacts_);
  visit("law", self.law_);
  visit("place", self.place_);
  visit("listed_position", self.listed_position_);
  visit("moved", self.moved_);
  visit("listed", self.listed_);
  visit("listed_at", self.listed_at_);
  visit("skin", self.skin_);
  visit("steps_done", self.steps_done_);
  visit("clock_time", self.clock_time_);
  visit("clock_steps", self.clock_steps_);
  visit("step", self.step_);
  visit("previous_step", self.previous_step_);
  visit("kick", self.kick_);
  visit("searches", self.searches_);
  visit("sweeps", self.sweeps_);
  visit("unconverged_steps", self.unconverged_steps_);
  visit("work", self.work_);
}

}  // namespace talus::dem
