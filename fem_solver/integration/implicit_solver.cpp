#include "fem_solver/integration/implicit_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/errors.hpp"
#include "core/steps.hpp"
#include "fem_solver/integration/external_force.hpp"

namespace talus::fem {
namespace {

/// Of the largest energy so far: from where on a step is not allowed to create more than round-off and the error of
/// works by the trapezoidal rule.
constexpr double largest_created = 0.01, largest_created_by_a_step = 1e-4;
/// After a start the method overshoots where a step cannot resolve a motion, and then forgets it (Chung and Hulbert,
/// section 5).
constexpr std::int64_t steps_of_overshoot = 3;

}  // namespace

ImplicitSolver::ImplicitSolver(const Model& model, Assembly& assembly, const ImplicitOptions& options,
                               const State& start)
    : Integrator(model, start),
      model_(model),
      assembly_(assembly),
      options_(options),
      held_(held_directions(model)),
      newton_(model) {
  const double r = options.spectral_radius;
  alpha_m_ = (2 * r - 1) / (r + 1);
  alpha_f_ = r / (r + 1);
  gamma_ = 0.5 - alpha_m_ + alpha_f_;
  beta_ = 0.25 * (1 - alpha_m_ + alpha_f_) * (1 - alpha_m_ + alpha_f_);
  const std::vector<double> zero(model.reference.size(), 0.0);
  static_cast<State&>(state_) = start;
  state_.acceleration = state_.force = state_.interface_force = zero;
  state_.reactions.assign(reaction_count(model), 0.0);
  mean_ = product_ = mean_displacement_ = zero;
  const auto [least, most] = std::ranges::minmax(model.reference);
  extent_ = most - least;
}

void ImplicitSolver::advance(double time, double length) {
  assembly_.start_step();
  if (state_.steps == 0) start(time);
  take_interface_force();
  reports_.clear();
  const double whole = length / static_cast<double>(core::steps_in(length, options_.step));
  const double end = time + length, smallest = smallest_share_of_step * whole;
  double share = whole;
  for (double now = time; now < end - 0.5 * smallest;) {
    const Step step{now, now + share > end - 0.5 * smallest ? end - now : share};
    if (take(step)) {
      now += step.length;
      continue;
    }
    share *= 0.5;
    if (share < smallest) report_failure(step);
  }
  assembly_.lap(StepStage::everything_else);
}

void ImplicitSolver::archive(core::StateArchive& archive) {
  fem::archive(archive, static_cast<State&>(state_));
  archive.values("acceleration", state_.acceleration);
  archive.values("force", state_.force);
  archive.values("interface_force", state_.interface_force);
  archive.values("reactions", state_.reactions);
  archive.count("steps", state_.steps);
  std::vector<double> energies{state_.damped, state_.created, state_.largest_energy};
  archive.values("damped_and_created", energies);
  state_.damped = energies[0];
  state_.created = energies[1];
  state_.largest_energy = energies[2];
  fem::archive(archive, state_.works);
}

/// The acceleration the first step starts from, before the interface's forces.
void ImplicitSolver::start(double time) {
  lead_supports_off(time);
  before_ = state_;
  assembly_.internal_force(state_.configuration(), state_.force);
  if (record_) record_->note_elements(time, state_.configuration(), assembly_.next_memory(), state_.record);
  add_external_force(model_, {}, {.time = time}, state_.force);
  std::vector<double> sum = state_.force;
  add_damping(-1, {state_.displacement, state_.velocity}, sum);
  state_.acceleration = newton_.accelerations({masses_of_directions(), sum}, state_.displacement);
  // What supports bear from the start on, so that their first work is booked whole.
  std::vector<double> needed(sum.size());
  for (std::size_t i = 0; i < sum.size(); ++i)
    needed[i] = model_.node_masses[i / 3] * state_.acceleration[i] - sum[i];
  newton_.slides().carry_over(needed);
  for (const HeldDirection& h : held_) state_.reactions[h.reaction] = needed[h.direction];
  if (record_) record_->note_supports(time, state_.reactions, state_.record);
}

/// Supports that a table leads have its rate from the start on: from rest they would ring about it. What that gives
/// their nodes is the supports' work.
void ImplicitSolver::lead_supports_off(double time) {
  for (const HeldDirection& h : held_) {
    if (h.displacement == 0) continue;
    double& velocity = state_.velocity[h.direction];
    const double led = h.support->history.rate_after(time) * h.displacement;
    state_.works.supports += 0.5 * h.mass(model_) * (led * led - velocity * velocity);
    velocity = led;
  }
}

void ImplicitSolver::take_interface_force() {
  std::vector<double> jump(state_.force.size(), 0.0);
  interface_.for_each([&](Index node, const auto& on_node) { Vector3::Map(&jump[3 * node]) = on_node; });
  if (jump == state_.interface_force) return;
  for (std::size_t i = 0; i < jump.size(); ++i) {
    const double now = jump[i];
    jump[i] -= state_.interface_force[i];
    state_.interface_force[i] = now;
    state_.force[i] += jump[i];
  }
  std::vector<double> place = state_.displacement;  // sliders are on their ropes already
  const std::vector<double> change = newton_.accelerations({masses_of_directions(), std::move(jump)}, place);
  for (std::size_t i = 0; i < change.size(); ++i) state_.acceleration[i] += change[i];
}

std::vector<double> ImplicitSolver::masses_of_directions() const {
  std::vector<double> masses;
  masses.reserve(model_.reference.size());
  for (const double m : model_.node_masses) masses.insert(masses.end(), 3, m);
  return masses;
}

bool ImplicitSolver::take(const Step& step) {
  before_ = state_;
  created_energy_ = false;
  energy_before_ = energy();
  predict(step);
  reports_.push_back(newton_.solve(system(step), options_.newton, state_.displacement));
  if (!reports_.back().converged) {
    state_ = before_;
    return false;
  }
  update_rates(step.length, state_.displacement);
  total_force(step.time + step.length, state_.displacement, state_.force);
  std::ranges::copy(assembly_.next_memory(), state_.memory.begin());
  account(step);
  created_energy_ = !keeps_energy();
  if (created_energy_) {
    state_ = before_;
    return false;
  }
  if (record_) {
    record_->note_elements(step.time + step.length, {state_.displacement, before_.memory}, state_.memory,
                           state_.record);
    record_->note_supports(step.time + step.length, state_.reactions, state_.record);
  }
  ++state_.steps;
  return true;
}

/// What is on the move, stored and dissipated, less what came from outside.
double ImplicitSolver::energy() const {
  const auto sum = [](const std::vector<double>& joules) {
    return std::accumulate(joules.begin(), joules.end(), 0.0);
  };
  const ExternalWorks& works = state_.works;
  return kinetic() + sum(elastic_by_parts(model_, state_.configuration())) +
         sum(dissipated_by_parts(model_, state_.configuration())) + state_.damped -
         (works.gravity + works.loads + works.interface + works.supports);
}

double ImplicitSolver::kinetic() const {
  double twice = 0;
  for (std::size_t i = 0; i < state_.velocity.size(); ++i)
    twice += model_.node_masses[i / 3] * state_.velocity[i] * state_.velocity[i];
  return 0.5 * twice;
}

bool ImplicitSolver::keeps_energy() {
  const ExternalWorks& works = state_.works;
  state_.largest_energy =
      std::max({state_.largest_energy, kinetic(),
                std::abs(works.gravity + works.loads + works.interface + works.supports)});
  if (state_.steps < steps_of_overshoot) return true;
  const double change = energy() - energy_before_;
  state_.created += change;
  const double no_energy =
      std::numeric_limits<double>::epsilon() * assembly_.largest_element_force() * extent_;
  return change <= std::max(no_energy, largest_created_by_a_step * state_.largest_energy) ||
         state_.created <= std::max(no_energy, largest_created * state_.largest_energy);
}

/// Free directions go on with constant acceleration, supported ones to where they are led.
void ImplicitSolver::predict(const Step& step) {
  for (std::size_t i = 0; i < state_.displacement.size(); ++i)
    state_.displacement[i] +=
        step.length * (before_.velocity[i] + 0.5 * step.length * before_.acceleration[i]);
  place_supports(held_, {.time = step.time + step.length}, state_.displacement);
}

void ImplicitSolver::update_rates(double dt, std::span<const double> displacement) {
  for (std::size_t i = 0; i < displacement.size(); ++i) {
    const double v0 = before_.velocity[i], a0 = before_.acceleration[i];
    const double advance = displacement[i] - before_.displacement[i] - dt * v0;
    state_.acceleration[i] = advance / (beta_ * dt * dt) - (0.5 / beta_ - 1) * a0;
    state_.velocity[i] = v0 + dt * ((1 - gamma_) * a0 + gamma_ * state_.acceleration[i]);
  }
}

void ImplicitSolver::residual(const Step& step, std::span<const double> displacement,
                              std::span<double> residual) {
  update_rates(step.length, displacement);
  assembly_.lap(StepStage::everything_else);
  total_force(step.time + step.length, displacement, residual);
  force_scale_ = assembly_.largest_element_force();
  for (std::size_t i = 0; i < residual.size(); ++i) {
    const double mean_acceleration =
        (1 - alpha_m_) * state_.acceleration[i] + alpha_m_ * before_.acceleration[i];
    const double inertia = model_.node_masses[i / 3] * mean_acceleration;
    force_scale_ = std::max({force_scale_, std::abs(residual[i]), std::abs(inertia)});
    residual[i] = (1 - alpha_f_) * residual[i] + alpha_f_ * before_.force[i] - inertia;
    mean_[i] = (1 - alpha_f_) * state_.velocity[i] + alpha_f_ * before_.velocity[i];
    mean_displacement_[i] = (1 - alpha_f_) * displacement[i] + alpha_f_ * before_.displacement[i];
  }
  add_damping(-1, {mean_displacement_, mean_}, residual);
}

void ImplicitSolver::add_damping(double factor, const Motion& motion, std::span<double> out) {
  const std::span<const double> velocity = motion.velocity;
  if (!model_.damping_rates.empty())
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] += factor * model_.damping_rates[i / 3] * model_.node_masses[i / 3] * velocity[i];
  if (largest_stiffness_damping(model_) > 0) {
    assembly_.damping_force({motion.displacement, before_.memory}, velocity, product_);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += factor * product_[i];
  }
}

NewtonSystem ImplicitSolver::system(const Step& step) {
  const double dt = step.length, rate = (1 - alpha_f_) * gamma_ / (beta_ * dt);
  NewtonSystem system{
      .residual = [this, step](std::span<const double> u, std::span<double> r) { residual(step, u, r); },
      .force_scale = [this] { return force_scale_; },
      .memory = state_.memory,
      .stiffness_factor = 1 - alpha_f_,
      .diagonal = std::vector<double>(model_.reference.size()),
      .damping_factor = largest_stiffness_damping(model_) > 0 ? rate : 0,
      .damping_state = {mean_displacement_, before_.memory}};
  const double inertia = (1 - alpha_m_) / (beta_ * dt * dt);
  for (std::size_t i = 0; i < system.diagonal.size(); ++i) {
    const double damping = model_.damping_rates.empty() ? 0 : rate * model_.damping_rates[i / 3];
    system.diagonal[i] = (inertia + damping) * model_.node_masses[i / 3];
  }
  return system;
}

/// External minus internal forces.
void ImplicitSolver::total_force(double time, std::span<const double> displacement, std::span<double> force) {
  assembly_.internal_force({displacement, state_.memory}, force);
  add_external_force(model_, interface_, {.time = time}, force);
}

/// Reactions, works by the trapezoidal rule, and what damping took.
void ImplicitSolver::account(const Step& step) {
  const std::size_t n = model_.reference.size();
  std::vector<double> change(n), needed(n, 0.0);
  add_damping(1, {state_.displacement, state_.velocity}, needed);
  for (std::size_t i = 0; i < n; ++i) {
    change[i] = state_.displacement[i] - before_.displacement[i];
    mean_[i] = 0.5 * (state_.velocity[i] + before_.velocity[i]);
    mean_displacement_[i] = 0.5 * (state_.displacement[i] + before_.displacement[i]);
    needed[i] += model_.node_masses[i / 3] * state_.acceleration[i] - state_.force[i];
  }
  newton_.slides().carry_over(needed);
  for (const HeldDirection& h : held_) {
    const double force = needed[h.direction];
    state_.works.supports += 0.5 * (state_.reactions[h.reaction] + force) * change[h.direction];
    state_.reactions[h.reaction] = force;
  }
  add_works(model_, interface_, {{.time = step.time}, {.time = step.time + step.length}}, change,
            state_.works);
  std::vector<double> damping(n, 0.0);
  add_damping(1, {mean_displacement_, mean_}, damping);
  for (std::size_t i = 0; i < n; ++i) state_.damped += damping[i] * change[i];
}

EnergyBalance ImplicitSolver::balance() {
  EnergyBalance balance;
  balance.kinetic = kinetic();
  balance.elastic = elastic_by_parts(model_, state_.configuration());
  balance.dissipated = dissipated_by_parts(model_, state_.configuration());
  balance.gravity = -state_.works.gravity;
  balance.bulk_damping = state_.damped;
  balance.loads = state_.works.loads;
  balance.supports = state_.works.supports;
  balance.interface = state_.works.interface;
  return balance;
}

void ImplicitSolver::report_failure(const Step& step) const {
  if (created_energy_)
    throw core::NumericalError({.what = "the step creates energy from nothing, even 1/1024 of it; write "
                                        "`implicit: {spectral_radius: 0.5}`, "
                                        "which takes what a step cannot follow, or a shorter step",
                                .entity = "energy created so far (J)",
                                .step = state_.steps,
                                .time = step.time,
                                .value = state_.created,
                                .last_output_time = last_output_time});
  throw core::NumericalError(
      {.what = "Newton's iteration does not converge, even for 1/1024 of the step",
       .entity = "relative residual of " + node_name(model_, reports_.back().worst_direction / 3),
       .step = state_.steps,
       .time = step.time,
       .value = reports_.back().residuals.back(),
       .last_output_time = last_output_time});
}

}  // namespace talus::fem
