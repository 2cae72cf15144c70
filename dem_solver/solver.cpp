#include "dem_solver/solver.hpp"

#include <algorithm>
#include <string>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "dem_solver/collision/size_classes.hpp"
#include "dem_solver/integration/leapfrog.hpp"

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
      threads_(model.threads),
      contacts_(make_contact_model(model.law)),
      gates_(std::move(model.gates)) {
  if (model.implicit_contact)
    implicit_contact_ = {.control = *model.implicit_contact, .gravity = model.gravity};
  spheres_.add(model.spheres, law_.rotation());
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
  clear_loads();
  evaluate_contacts();
  core::lap(stage_clock_, with_boundary);
  move_spheres();
  previous_step_ = step_;
  core::lap(stage_clock_, motion);
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
  const PairList::Rebuilt rebuilt = pair_list_.rebuild(spheres_, skin_, threads_);
  const std::vector<SlotMove> plane_moves =
      plane_list_.rebuild(planes_, spheres_, rebuilt.new_place, wall_skin());
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
  moved_ = {};
  listed_ = true;
  listed_at_ = steps_done_;
  ++searches_;
  // Twice: the lists serve until a sphere has moved that far, and that is seen a step later.
  if (!gates_.empty()) gates_.watch_all({spheres_, rocks_, time()}, 2 * wall_skin());
}

bool ParticleSolver::lists_are_used_up() noexcept {
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

void ParticleSolver::clear_loads() noexcept {
  const bool turn = spheres_.rotates();
  core::parallel_runs({spheres_.size(), threads_}, [&](core::Block run) {
    std::fill(spheres_.force.begin() + run.begin, spheres_.force.begin() + run.end, Row{});
    if (turn) std::fill(spheres_.torque.begin() + run.begin, spheres_.torque.begin() + run.end, Row{});
  });
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
          .implicit_contact = implicit_contact_ ? &*implicit_contact_ : nullptr,
          .step = last_step(),
          .threads = threads_,
          .clock = stage_clock_};
}

void ParticleSolver::evaluate_contacts() noexcept {
  const ContactStage stage = contact_stage();
  std::visit(
      [&](auto& model) {
        const int sweeps = model.evaluate(stage);
        work_ += model.last_work();
        if (!implicit_contact_) return;
        sweeps_ += sweeps;
        if (sweeps > implicit_contact_->control.most_sweeps) ++unconverged_steps_;
      },
      contacts_);
}

void ParticleSolver::move_spheres() {
  const LeapfrogStep how{.gravity = gravity_, .step = step_, .kick = kick_, .threads = threads_};
  MotionSummary motion = kick_and_drift(spheres_, how);
  if (!rocks_.empty()) {
    rocks_.move(spheres_, place_, how);
    const double speed = rocks_.place_members(spheres_, place_);
    motion.largest_speed = std::max(motion.largest_speed, speed);
    motion.finite = motion.finite && std::isfinite(speed);
  }
  if (!motion.finite) report_not_finite();
  moved_.alone += motion.largest_speed * step_;
  moved_.towards_another += 2 * motion.largest_speed * step_;
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
    const Triple<double> w = triple<double>(spheres_.spin[i]);
    ledger.rotation += 0.5 * inertia * dot(w, w - (last.kick / inertia) * triple<double>(spheres_.torque[i]));
  }
}

ParticleLedger ParticleSolver::ledger() const noexcept {
  ParticleLedger ledger{.damping = work_.damping, .friction = work_.friction, .boundary = work_.boundary};
  add_spheres_to(ledger);
  for (Index k = 0; k < rocks_.size(); ++k) {
    const Rocks::Energy energy = rocks_.energy(k, last_leap());
    ledger.kinetic += energy.translation;
    ledger.rotation += energy.rotation;
  }
  ledger.elastic = std::visit([](const auto& model) { return model.stored_energy(); }, contacts_);
  ledger.gravity = gravity_work_level() - gravity_level_at_start_;
  return ledger;
}

}  // namespace talus::dem
