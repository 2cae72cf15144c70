#include "dem_solver/solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "dem_solver/collision/block_sweep.hpp"
#include "dem_solver/collision/size_classes.hpp"

namespace talus::dem {

namespace {

/// A thicker skin lengthens every list, a thinner one is used up in fewer steps.
struct SkinRule {
  static constexpr double first = 0.1, thinnest = 0.05, thickest = 0.5;  // in radii of the most frequent size
  static constexpr double wanted_steps = 100;                            ///< from one search to the next
  static constexpr double most_change = 2;                               ///< from one list to the next
};

double main_radius(const Spheres& spheres) {
  return 0.5 * SizeClasses(spheres, 0).main_cell();
}

}  // namespace

ParticleSolver::ParticleSolver(ParticleModel model)
    : planes_(std::move(model.planes)),
      boundary_(std::move(model.boundary)),
      pairs_(std::move(model.pairs)),
      law_(model.law),
      gravity_(model.gravity),
      step_(model.step),
      skin_(model.skin),
      contact_rule_(model.contact_rule),
      threads_(model.threads),
      may_be_unstable_(model.may_be_unstable),
      contacts_(make_contact_model(model.law)),
      gates_(std::move(model.gates)) {
  if (model.implicit_contact)
    implicit_contact_ = {.control = *model.implicit_contact, .gravity = model.gravity};
  spheres_.add(model.spheres, {.rotation = law_.rotation(), .facing = law_.spreads_over_area()});
  rocks_ = Rocks(model.rocks, model.spheres);
  if (skin_ <= 0 && spheres_.size() > 0) {
    main_radius_ = main_radius(spheres_);
    skin_ = SkinRule::first * main_radius_;
  }
  place_ = spheres_.places();
  if (!gates_.empty()) gates_.watch_all({spheres_, rocks_, time()}, skin_);
  gravity_level_at_start_ = gravity_work_level();
}

ParticleSolver::ParticleSolver(const ParticleSolver& other) = default;
ParticleSolver::ParticleSolver(ParticleSolver&& other) noexcept = default;
ParticleSolver& ParticleSolver::operator=(const ParticleSolver& other) = default;
ParticleSolver& ParticleSolver::operator=(ParticleSolver&& other) noexcept = default;
ParticleSolver::~ParticleSolver() = default;

void ParticleSolver::step() {
  core::start(stage_clock_);
  kick_ = 0.5 * (last_step() + step_);
  boundary_.drift(time());
  find_neighbours();
  core::lap(stage_clock_, search);
  if (loads_end_with_blocks())
    advance_block_by_block();
  else
    advance_stage_by_stage();
  if (!rocks_.empty()) move_rocks();
  core::lap(stage_clock_, motion);
  watch_motion();
  if (!rocks_.empty() && !may_be_unstable_) watch_rocks();
  previous_step_ = step_;
  ++steps_done_;
  if (!gates_.empty()) gates_.watch_near({spheres_, rocks_, time()});
}

void ParticleSolver::set_clock(const Clock& clock) noexcept {
  clock_time_ = clock.time;
  clock_steps_ = steps_done_;
  step_ = clock.step;
}

void ParticleSolver::find_neighbours() {
  if (spheres_.size() == 0 || (listed_ && !lists_are_used_up())) return;
  if (listed_) skin_ = next_skin();
  std::vector<Index> contacts(spheres_.position.size());
  pair_list_.count_contacts(contacts);
  plane_list_.count_contacts(contacts);
  const PairList::Rebuilt rebuilt = pair_list_.rebuild(spheres_, {skin_, threads_, contacts});
  const std::vector<SlotMove> plane_moves =
      plane_list_.rebuild(planes_, spheres_, pair_list_.block_first(), rebuilt.new_place, wall_skin());
  std::vector<SlotMove> boundary_moves;
  if (!boundary_.empty())
    boundary_moves = boundary_list_.rebuild(boundary_, spheres_, rebuilt.new_place, wall_skin());
  const ContactStage stage = contact_stage();
  std::visit(
      [&](auto& model) {
        model.rebuild(stage, {rebuilt.moves, plane_moves, boundary_moves});
      },
      contacts_);
  place_ = spheres_.places();
  listed_position_ = spheres_.position;
  block_motion_.assign(static_cast<std::size_t>(pair_list_.block_count()), {});
  moved_ = {};
  listed_ = true;
  listed_at_ = steps_done_;
  ++searches_;
  // Twice: the lists serve until a sphere has moved that far, and that is seen a step later.
  if (!gates_.empty()) gates_.watch_all({spheres_, rocks_, time()}, 2 * wall_skin());
}

bool ParticleSolver::lists_are_used_up() noexcept {
  if (boundary_list_.has_lost_cells(boundary_)) return true;
  const double boundary_motion = boundary_.empty() ? 0 : boundary_list_.boundary_motion(boundary_);
  const auto used_up = [&] {
    return moved_.towards_another >= skin_ || moved_.alone + boundary_motion >= wall_skin();
  };
  if (!used_up()) return false;
  // The bound adds up the largest speeds of different spheres; what they really moved is often far less.
  moved_ = measured_motion();
  return used_up();
}

double ParticleSolver::next_skin() const noexcept {
  if (main_radius_ == 0) return skin_;
  const auto lasted = static_cast<double>(std::max<std::int64_t>(1, steps_done_ - listed_at_));
  const double change =
      std::clamp(SkinRule::wanted_steps / lasted, 1 / SkinRule::most_change, SkinRule::most_change);
  return std::clamp(change * skin_, SkinRule::thinnest * main_radius_, SkinRule::thickest * main_radius_);
}

void ParticleSolver::fit_to_state() {
  // Every contact keeps its place: what remains of a rebuild is the sizing of the work arrays.
  const auto in_place = [](Index slots) {
    std::vector<SlotMove> moves;
    for (Index slot = 0; slot < slots; ++slot) moves.push_back({slot, slot});
    return moves;
  };
  const auto pairs = in_place(pair_list_.slots()), planes = in_place(plane_list_.slots()),
             boundary = in_place(boundary_list_.slots());
  const ContactStage stage = contact_stage();
  if (listed_) std::visit([&](auto& model) { model.rebuild(stage, {pairs, planes, boundary}); }, contacts_);
  block_motion_.resize(static_cast<std::size_t>(pair_list_.block_count()));
}

ParticleSolver::Motion ParticleSolver::measured_motion() const noexcept {
  const auto moved = [this](Index i) {
    return triple<double>(spheres_.position[i]) - triple<double>(listed_position_[i]);
  };
  Triple<double> sum;
  for (Index i = 0; i < spheres_.size(); ++i) sum = sum + moved(i);
  const Triple<double> mean = (1.0 / spheres_.size()) * sum;
  // Two spheres approach each other by what they moved against the mean, which no pair notices.
  double alone = 0, most = 0, second = 0;  // squared
  for (Index i = 0; i < spheres_.size(); ++i) {
    const Triple<double> own = moved(i), against_mean = own - mean;
    const double squared = dot(against_mean, against_mean);
    alone = std::max(alone, dot(own, own));
    second = std::max(second, std::min(most, squared));
    most = std::max(most, squared);
  }
  return {.alone = std::sqrt(alone), .towards_another = std::sqrt(most) + std::sqrt(second)};
}

bool ParticleSolver::loads_end_with_blocks() const noexcept {
  return boundary_.empty() && pair_list_.wide().empty() && stage_clock_ == nullptr;
}

// The law is looked up for every block, which costs nothing beside it, so that the sweeps are compiled once and not for each
// law.
void ParticleSolver::meet_each_other(const ContactStage& stage, Index block) noexcept {
  std::visit([&](auto& contacts) { contacts.between_spheres(stage, block); }, contacts_);
}

void ParticleSolver::meet_planes(const ContactStage& stage, Index block) noexcept {
  std::visit([&](auto& contacts) { contacts.with_planes(stage, block); }, contacts_);
}

void ParticleSolver::advance_block_by_block() noexcept {
  const ContactStage stage = contact_stage();
  sweep_blocks(
      {pair_list_.block_count(), threads_},
      [&](Index block) { spheres_.clear_loads(pair_list_.places(block)); },
      [&](Index block) { meet_each_other(stage, block); },
      [&](Index block) {
        if (!planes_.empty()) meet_planes(stage, block);
        move_block(block);
      });
}

void ParticleSolver::advance_stage_by_stage() noexcept {
  const ContactStage stage = contact_stage();
  const core::Tasks blocks{pair_list_.block_count(), threads_};
  sweep_blocks(
      blocks, [&](Index block) { spheres_.clear_loads(pair_list_.places(block)); },
      [&](Index block) { meet_each_other(stage, block); }, [](Index) {});
  if (!pair_list_.wide().empty())
    std::visit([&](auto& contacts) { contacts.between_distant_spheres(stage); }, contacts_);
  core::lap(stage_clock_, between_spheres);
  if (!planes_.empty())
    core::parallel_tasks(blocks, [&](std::int64_t block) { meet_planes(stage, static_cast<Index>(block)); });
  core::lap(stage_clock_, with_planes);
  if (!boundary_.empty()) meet_boundary(stage);
  core::lap(stage_clock_, with_boundary);
  core::parallel_tasks(blocks, [&](std::int64_t block) { move_block(static_cast<Index>(block)); });
}

ContactStage ParticleSolver::contact_stage() noexcept {
  return {.spheres = spheres_,
          .rocks = rocks_,
          .place = place_,
          .planes = planes_,
          .boundary = boundary_,
          .pair_list = pair_list_,
          .plane_list = plane_list_,
          .boundary_list = boundary_list_,
          .table = pairs_,
          .contact_rule = contact_rule_,
          .implicit_contact = implicit_contact_ ? &*implicit_contact_ : nullptr,
          .step = last_step(),
          .threads = threads_};
}

void ParticleSolver::meet_boundary(const ContactStage& stage) noexcept {
  const int sweeps = std::visit([&](auto& contacts) { return contacts.with_boundary(stage); }, contacts_);
  if (!implicit_contact_) return;
  sweeps_ += sweeps;
  if (sweeps > implicit_contact_->control.most_sweeps) ++unconverged_steps_;
}

void ParticleSolver::move_block(Index block) noexcept {
  block_motion_[block] = kick_and_drift(spheres_, pair_list_.places(block), this_leap());
}

void ParticleSolver::move_rocks() noexcept {
  rocks_.move(spheres_, place_, this_leap());
  const double speed = rocks_.place_members(spheres_, place_);
  block_motion_.front() += {.largest_speed = speed, .finite = std::isfinite(speed)};
}

void ParticleSolver::watch_motion() {
  work_ += std::visit([](const auto& contacts) { return contacts.last_work(); }, contacts_);
  MotionSummary motion;
  for (const MotionSummary& of_block : block_motion_) motion += of_block;
  if (!motion.finite) report_not_finite();
  moved_.alone += motion.largest_speed * step_;
  moved_.towards_another += 2 * motion.largest_speed * step_;
}

void ParticleSolver::watch_rocks() const {
  const Rocks::Stiffest stiffest = rocks_.stiffest(spheres_, place_, step_);
  constexpr double limit = 4;  // of the leapfrog, (w dt)^2
  if (!(stiffest.ratio > limit)) return;
  throw core::NumericalError(
      {.what = fmt::format(
           "the contacts of a rock are together too stiff for the step: {:.3g} s is its limit now, "
           "{:.3g} s the step",
           step_ * std::sqrt(limit / stiffest.ratio), step_),
       .entity = "rock " + rocks_.name(stiffest.rock),
       .step = steps_done_,
       .time = time(),
       .value = stiffest.ratio});
}

void ParticleSolver::report_not_finite() const {
  for (Index i = 0; i < spheres_.size(); ++i) {
    const Row& v = spheres_.velocity[i];
    const double speed = length(triple<double>(v));
    if (std::isfinite(speed)) continue;
    throw core::NumericalError({.what = "velocity is not finite",
                                .entity = "sphere " + std::to_string(spheres_.id[i]),
                                .step = steps_done_,
                                .time = time(),
                                .value = speed});
  }
  throw core::NumericalError(
      {.what = "velocities overflow", .entity = "all spheres", .step = steps_done_, .time = time()});
}

LeapfrogStep ParticleSolver::last_leap() const noexcept {
  return {.gravity = gravity_, .step = previous_step_, .kick = kick_};
}

double ParticleSolver::gravity_work_level() const noexcept {
  // After a step the positions are one drift ahead of the last forces.
  const double back = previous_step_;
  const auto level = [&](double mass, const Triple<double>& position, const Triple<double>& velocity) {
    return mass * dot(gravity_, position - back * velocity);
  };
  double sum = 0;
  for (Index i = 0; i < spheres_.size(); ++i)
    if (!spheres_.in_rock(i))
      sum += level(spheres_.velocity[i].w, triple<double>(spheres_.position[i]),
                   triple<double>(spheres_.velocity[i]));
  for (Index k = 0; k < rocks_.size(); ++k)
    sum += level(rocks_.mass(k), rocks_.centre(k), rocks_.velocity(k));
  return sum;
}

void ParticleSolver::add_spheres_to(ParticleLedger& ledger) const noexcept {
  const LeapfrogStep last = last_leap();
  for (Index i = 0; i < spheres_.size(); ++i) {
    if (spheres_.in_rock(i)) continue;
    const double mass = spheres_.velocity[i].w, radius = spheres_.position[i].w;
    const Triple<double> v = triple<double>(spheres_.velocity[i]);
    const Triple<double> acceleration = (1 / mass) * triple<double>(spheres_.force[i]) + gravity_;
    const Triple<double> before = v - last.kick * acceleration;
    ledger.kinetic += 0.5 * mass * (dot(v, before) - product_of_unequal_steps(last, v, acceleration));
    if (!spheres_.rotates()) continue;
    const double inertia = 0.4 * mass * radius * radius;
    const Triple<double> w = triple<double>(spheres_.spin[i]),
                         turning = (1 / inertia) * triple<double>(spheres_.torque[i]);
    ledger.rotation +=
        0.5 * inertia * (dot(w, w - last.kick * turning) - product_of_unequal_steps(last, w, turning));
  }
}

/// Before the first step nobody has looked at the contacts: a copy does.
double ParticleSolver::stored_energy() const {
  if (steps_done_ == 0 && spheres_.size() > 0) {
    ParticleSolver ahead = *this;
    ahead.stage_clock_ = nullptr;
    ahead.step();
    return ahead.stored_energy();
  }
  return std::visit([](const auto& model) { return model.stored_energy(); }, contacts_);
}

ParticleLedger ParticleSolver::ledger() const {
  ParticleLedger ledger{.damping = work_.damping, .friction = work_.friction, .boundary = work_.boundary};
  add_spheres_to(ledger);
  for (Index k = 0; k < rocks_.size(); ++k) {
    const Rocks::Energy energy = rocks_.energy(k, last_leap());
    ledger.kinetic += energy.translation;
    ledger.rotation += energy.rotation;
  }
  ledger.elastic = stored_energy();
  ledger.gravity = gravity_work_level() - gravity_level_at_start_;
  return ledger;
}

}  // namespace talus::dem
