#include "fem_solver/integration/explicit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/errors.hpp"
#include "core/steps.hpp"
#include "fem_solver/integration/external_force.hpp"

namespace talus::fem {
namespace {

struct NoTerm {};
struct MassDampingTerm {};

}  // namespace

ExplicitSolver::ExplicitSolver(const Model& model, Assembly& assembly, double step, const State& start)
    : Integrator(model, start), model_(model), assembly_(assembly), longest_step_(step), slides_(model) {
  const std::size_t values = model.reference.size();
  static_cast<State&>(state_) = start;
  state_.force.assign(values, 0);
  state_.reactions.assign(reaction_count(model), 0);
  for (const double m : model.node_masses) inverse_mass_.insert(inverse_mass_.end(), 3, m > 0 ? 1 / m : 0);
  if (!model.damping_rates.empty())
    for (std::size_t node = 0; node < model.node_masses.size(); ++node) {
      mass_.insert(mass_.end(), 3, model.node_masses[node]);
      damping_rate_.insert(damping_rate_.end(), 3, model.damping_rates[node]);
    }
  if (largest_stiffness_damping(model) > 0) damping_force_.resize(values);
  sum_.reserve(static_cast<std::int64_t>(values));
  for (const HeldDirection& h : held_directions(model))
    if (h.displacement != 0)
      led_.push_back(h);
    else
      fixed_.push_back({static_cast<std::uint32_t>(h.direction), static_cast<std::uint32_t>(h.reaction)});
  fixed_.shrink_to_fit();
  if (slides_.exists()) state_.slides = slides_.find(start.displacement);
}

void ExplicitSolver::advance(double time, double length) {
  const std::int64_t steps = core::steps_in(length, longest_step_);
  const double step_length = length / static_cast<double>(steps);
  if (stays_at_rest(time, step_length)) {
    state_.steps += steps;
    state_.previous_step = step_length;
    return;
  }
  force_evaluations_ += steps;
  for (std::int64_t k = 0; k < steps; ++k) step(time + static_cast<double>(k) * step_length, step_length);
}

bool ExplicitSolver::stays_at_rest(double time, double step) noexcept {
  if (state_.rest == Rest::to_be_seen)
    state_.rest = starts_in_balance(time, step) ? Rest::rests : Rest::moves;
  if (interface_.touched()) state_.rest = Rest::moves;
  return state_.rest == Rest::rests;
}

bool ExplicitSolver::starts_in_balance(double time, double step) noexcept {
  constexpr double round_off = 1e-12;  // of the largest force, summed over the elements at a node
  const auto is_zero = [](double value) { return value == 0; };
  if (state_.steps > 0 || !std::ranges::all_of(state_.velocity, is_zero)) return false;
  if (std::ranges::any_of(model_.supports, &Support::moves)) return false;
  if (!model_.gravity_history.points.empty()) return false;
  if (!std::ranges::all_of(model_.loads, [](const auto& load) { return load.history.points.empty(); }))
    return false;
  state_.kick = 0.5 * step;
  evaluate_forces(time);
  impose_supports(time, step);
  if (record_) {
    record_->note_elements(time, state_.configuration(), assembly_.next_memory(), state_.record);
    record_->note_supports(time, state_.reactions, state_.record);
  }
  const double allowed = round_off * assembly_.largest_element_force();
  return std::ranges::all_of(state_.force, [=](double value) { return std::abs(value) <= allowed; });
}

void ExplicitSolver::archive(core::StateArchive& archive) {
  fem::archive(archive, state_);
  archive.values("force", state_.force);
  archive.values("reactions", state_.reactions);
  if (slides_.exists()) {
    archive.values("slider_segments", state_.slides.segments);
    archive.values("slider_moves", state_.slides.moves);
  }
  archive.count("steps", state_.steps);
  auto rest = static_cast<std::int64_t>(state_.rest);
  archive.count("rest", rest);
  state_.rest = static_cast<Rest>(rest);
  std::vector<double> numbers{state_.previous_step, state_.kick, state_.damped};
  for (const auto& work : state_.works) numbers.insert(numbers.end(), {work.done, work.pending});
  archive.values("times_and_works", numbers);
  prepared_ = false;
  state_.previous_step = numbers[0];
  state_.kick = numbers[1];
  state_.damped = numbers[2];
  for (std::size_t k = 0; k < state_.works.size(); ++k)
    state_.works[k] = {numbers[3 + 2 * k], numbers[4 + 2 * k]};
}

void ExplicitSolver::step(double time, double step) {
  assembly_.start_step();
  state_.kick = 0.5 * (state_.previous_step + step);
  if (slides_.exists()) book_moves();
  evaluate_forces(time);
  if (record_) record_->note_elements(time, state_.configuration(), assembly_.next_memory(), state_.record);
  std::ranges::copy(assembly_.next_memory(), state_.memory.begin());
  impose_supports(time, step);
  assembly_.lap(StepStage::other_forces);
  arrive(time);
  assembly_.lap(StepStage::energy);
  if (slides_.exists()) velocity_before_ = state_.velocity;
  const double activity = advance_free(step);
  assembly_.lap(StepStage::motion);
  if (slides_.exists()) {
    hold_slides(time, step);
    damp_sliding_nodes(step);
  }
  assembly_.lap(StepStage::slides);
  if (record_) record_->note_supports(time, state_.reactions, state_.record);
  leave(time, step);
  assembly_.lap(StepStage::energy);
  state_.previous_step = step;
  ++state_.steps;
  prepared_ = false;
  if (!std::isfinite(activity)) report_blow_up(time + step);
  if (watch_ && state_.steps % StepWatch::interval == 0)
    watch_->look({state_.configuration(), step, time + step, state_.steps, last_output_time});
  assembly_.lap(StepStage::everything_else);
}

void ExplicitSolver::evaluate_forces(double time) noexcept {
  evaluate_own_forces(time, state_.force);
  interface_.for_each(
      [&](Index node, const auto& on_node) { Vector3::Map(&state_.force[3 * node]) += on_node; });
}

void ExplicitSolver::prepare() {
  if (prepared_) return;
  element_force_.resize(state_.displacement.size());
  assembly_.internal_force(state_.configuration(), element_force_);
  prepared_ = true;
}

void ExplicitSolver::evaluate_own_forces(double time, std::span<double> force) noexcept {
  if (prepared_)
    std::ranges::copy(element_force_, force.begin());
  else
    assembly_.internal_force(state_.configuration(), force);
  if (!damping_force_.empty()) subtract_stiffness_damping(force);
  add_external_force(model_, {}, {.time = time}, force);
}

// Not in state_.force, which has to stay that of the last step: the energy balance reads it.
std::span<const double> ExplicitSolver::free_velocity(double time, double step) {
  assembly_.start_step();
  prepare();
  free_velocity_.resize(state_.velocity.size());
  evaluate_own_forces(time, free_velocity_);
  const double kick = 0.5 * (state_.previous_step + step);
  for (std::size_t i = 0; i < free_velocity_.size(); ++i) {
    const double half_damping = damping_rate_.empty() ? 0 : 0.5 * damping_rate_[i] * kick;
    free_velocity_[i] =
        ((1 - half_damping) * state_.velocity[i] + kick * inverse_mass_[i] * free_velocity_[i]) /
        (1 + half_damping);
  }
  for (const Fixed& fixed : fixed_) free_velocity_[fixed.direction] = 0;
  for (const HeldDirection& h : led_)
    free_velocity_[h.direction] =
        (h.support->history.at(time + step) * h.displacement - state_.displacement[h.direction]) / step;
  assembly_.lap(StepStage::other_forces);
  return free_velocity_;
}

void ExplicitSolver::subtract_stiffness_damping(std::span<double> force) noexcept {
  assembly_.damping_force(state_.configuration(), state_.velocity, damping_force_);
  core::parallel_for(static_cast<std::int64_t>(force.size()),
                     [&](std::int64_t i) { force[i] -= damping_force_[i]; });
}

void ExplicitSolver::impose_supports(double time, double step) noexcept {
  const auto hold = [&](std::size_t i, std::size_t reaction, double mass, double velocity_after) {
    const double half_damping = half_damping_of(i / 3);
    const double momentum_change =
        (1 + half_damping) * velocity_after - (1 - half_damping) * state_.velocity[i];
    const double needed = mass * momentum_change / state_.kick;
    state_.reactions[reaction] = needed - state_.force[i];
    state_.force[i] = needed;
  };
  for (const auto& [direction, reaction] : fixed_)
    hold(direction, reaction, model_.node_masses[direction / 3], 0.0);
  for (const HeldDirection& h : led_)
    hold(h.direction, h.reaction, h.mass(model_),
         (h.support->history.at(time + step) * h.displacement - state_.displacement[h.direction]) / step);
}

/// Eight directions at a time, their sums apart: a fixed order that fits vector registers.
template <bool damped>
double ExplicitSolver::advance_values(const Leap& leap, core::Block values) noexcept {
  constexpr std::int64_t width = 8;
  double* __restrict velocity = state_.velocity.data();
  double* __restrict displacement = state_.displacement.data();
  const double* __restrict force = state_.force.data();
  const double* __restrict inverse_mass = inverse_mass_.data();
  const double* __restrict mass = mass_.data();
  const double* __restrict rate = damping_rate_.data();
  const double half_after = 0.5 * leap.step;
  const auto advance = [&](std::int64_t i) {
    const double before = velocity[i];
    double keep = 1, gain = leap.kick;
    if constexpr (damped) {
      const double half_damping = 0.5 * rate[i] * leap.kick;
      keep = (1 - half_damping) / (1 + half_damping);
      gain = leap.kick / (1 + half_damping);
    }
    const double after = (damped ? keep * before : before) + gain * inverse_mass[i] * force[i];
    velocity[i] = after;
    displacement[i] += leap.step * after;
    return damped ? rate[i] * mass[i] * ((before + after) * (leap.half_before * before + half_after * after))
                  : after * after;
  };
  std::array<double, width> sums{};
  std::int64_t i = values.begin;
  for (; i + width <= values.end; i += width)
    for (std::int64_t lane = 0; lane < width; ++lane) sums[lane] += advance(i + lane);
  double sum = 0;
  for (; i < values.end; ++i) sum += advance(i);
  for (const double lane : sums) sum += lane;
  return sum;
}

template <class MassDamping>
double ExplicitSolver::advance_nodes(double step) noexcept {
  constexpr bool damped = std::is_same_v<MassDamping, MassDampingTerm>;
  const Leap leap{.kick = state_.kick, .half_before = 0.5 * state_.previous_step, .step = step};
  const double sum = sum_.of_blocks(static_cast<std::int64_t>(state_.velocity.size()), 0.0,
                                    [&](core::Block values) { return advance_values<damped>(leap, values); });
  if constexpr (damped)
    if (!slides_.exists()) state_.damped += 0.5 * sum;
  return sum;
}

double ExplicitSolver::advance_free(double step) noexcept {
  return mass_.empty() ? advance_nodes<NoTerm>(step) : advance_nodes<MassDampingTerm>(step);
}

void ExplicitSolver::damp_sliding_nodes(double step) noexcept {
  if (mass_.empty()) return;
  const double half_before = 0.5 * state_.previous_step, half_after = 0.5 * step;
  const double sum = sum_.of_blocks(static_cast<std::int64_t>(mass_.size()), 0.0, [&](core::Block values) {
    double joules = 0;
    for (auto i = static_cast<std::size_t>(values.begin); i < static_cast<std::size_t>(values.end); ++i) {
      const double before = velocity_before_[i], after = state_.velocity[i];
      joules +=
          damping_rate_[i] * mass_[i] * ((before + after) * (half_before * before + half_after * after));
    }
    return joules;
  });
  state_.damped += 0.5 * sum;
}

// Constraint forces do no work on a motion along the rope; what is left is of the order of the step.
void ExplicitSolver::hold_slides(double time, double step) {
  ExplicitState::Work& work = state_.works[by_slides];
  const bool converged =
      slides_.hold({.length = step, .kick = state_.kick},
                   {state_.displacement, state_.velocity, state_.force, state_.reactions, state_.slides});
  if (!converged) {
    std::size_t worst = 0;
    for (std::size_t k = 1; k < model_.constrained_slides.size(); ++k)
      if (slides_.largest_violation(k) > slides_.largest_violation(worst)) worst = k;
    throw core::NumericalError({.what = "the impulses that hold sliders on their ropes do not converge",
                                .entity = "largest gap (m) of slide " + model_.constrained_slides[worst].name,
                                .step = state_.steps,
                                .time = time,
                                .value = slides_.largest_violation(worst),
                                .last_output_time = last_output_time});
  }
  work.done += work.pending + 0.5 * state_.previous_step * slides_.power(velocity_before_);
  work.pending = 0.5 * step * slides_.power(state_.velocity);
}

void ExplicitSolver::book_moves() {
  prepare();
  double work = slides_.work_of_moves(state_.slides, element_force_);
  if (model_.gravity_history.points.empty() && !model_.weight.empty())
    work += slides_.work_of_moves(state_.slides, model_.weight);
  state_.works[by_slides].done -= work;
}

void ExplicitSolver::report_blow_up(double time) const {
  const auto worst = std::ranges::max_element(state_.velocity, {}, [](double v) {
    return std::isfinite(v) ? std::abs(v) : std::numeric_limits<double>::infinity();
  });
  const auto node = static_cast<Index>((worst - state_.velocity.begin()) / 3);
  throw core::NumericalError({.what = "the velocity is not finite",
                              .entity = "velocity of " + node_name(model_, node),
                              .step = state_.steps,
                              .time = time,
                              .value = *worst,
                              .last_output_time = last_output_time});
}

}  // namespace talus::fem
