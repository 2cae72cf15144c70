// What an explicit run knows of its energies. The step itself: explicit.cpp.
#include <algorithm>

#include "fem_solver/integration/explicit.hpp"
#include "fem_solver/integration/external_force.hpp"

namespace talus::fem {

// A force at t_n does half its work over the step before t_n and half over the step after it; only so does
// the sum of works match the leapfrog's invariant. arrive() books the first half, leave() keeps the second
// for the next arrival.
void ExplicitSolver::arrive(double time) noexcept {
  const Powers power = powers(time);
  const double half = 0.5 * state_.previous_step;
  for (std::size_t k = 0; k < power.size(); ++k)
    state_.works[k].done += state_.works[k].pending + half * power[k];
}

void ExplicitSolver::leave(double time, double step) noexcept {
  const Powers power = powers(time);
  for (std::size_t k = 0; k < power.size(); ++k) state_.works[k].pending = 0.5 * step * power[k];
}

ExplicitSolver::Powers ExplicitSolver::powers(double time) const noexcept {
  Powers power{};
  for (const auto& load : model_.loads) {
    const Vector3 force = load.history.at(time) * load.force;
    for (const Index node : load.nodes)
      power[by_loads] += force.dot(Vector3::Map(&state_.velocity[3 * node]));
  }
  if (std::ranges::any_of(model_.supports, &Support::moves)) power[by_supports] = power_of_supports();
  interface_.for_each([&](Index node, const auto& on_node) {
    power[by_interface] += on_node.dot(Vector3::Map(&state_.velocity[3 * node]));
  });
  if (!model_.gravity_history.points.empty() && !model_.weight.empty()) {
    const double factor = model_.gravity_history.at(time);
    for (std::size_t i = 0; i < model_.weight.size(); ++i)
      power[by_gravity] += factor * model_.weight[i] * state_.velocity[i];
  }
  for (std::size_t i = 0; i < damping_force_.size(); ++i)
    power[by_stiffness_damping] += damping_force_[i] * state_.velocity[i];
  return power;
}

double ExplicitSolver::power_of_supports() const noexcept {
  double power = 0;
  for (const HeldDirection& h : led_) power += state_.reactions[h.reaction] * state_.velocity[h.direction];
  return power;
}

// Before the first step nothing has been evaluated. What is evaluated for the balance is not kept: a run restarted
// from here has to write the same first row.
EnergyBalance ExplicitSolver::balance() {
  if (state_.steps > 0) return balance_at_evaluation();
  const ExplicitState start = state_;
  state_.kick = 0.5 * longest_step_;
  evaluate_forces(0);
  impose_supports(0, longest_step_);
  if (slides_.exists()) {  // their constraints' forces follow from a step that is not taken
    velocity_before_ = state_.velocity;
    advance_free(longest_step_);
    hold_slides(0, longest_step_);
    state_.displacement = start.displacement;
    state_.velocity = start.velocity;
    state_.works = start.works;
    state_.slides = start.slides;
  }
  const EnergyBalance balance = balance_at_evaluation();
  state_ = start;
  return balance;
}

EnergyBalance ExplicitSolver::balance_at_evaluation() const {
  const std::vector<double> displacement = displacement_at_evaluation();
  EnergyBalance balance;
  add_kinetic(balance);
  const Configuration at(displacement, state_.memory);
  balance.elastic = elastic_by_parts(model_, at);
  balance.dissipated = dissipated_by_parts(model_, at);
  balance.gravity = -state_.works[by_gravity].done;  // what changes has no potential
  if (model_.gravity_history.points.empty())
    for (std::size_t i = 0; i < model_.weight.size(); ++i)
      balance.gravity -= model_.weight[i] * displacement[i];
  balance.bulk_damping += state_.damped + state_.works[by_stiffness_damping].done;
  balance.loads = state_.works[by_loads].done;
  balance.supports = state_.works[by_supports].done;
  balance.interface = state_.works[by_interface].done;
  balance.slides = -state_.works[by_slides].done;
  return balance;
}

std::vector<double> ExplicitSolver::displacement_at_evaluation() const {
  std::vector<double> displacement = state_.displacement;
  if (slides_.exists()) slides_.undo_moves(state_.slides, displacement);
  for (std::size_t i = 0; i < displacement.size(); ++i)
    displacement[i] -= state_.previous_step * state_.velocity[i];
  return displacement;
}

// The velocity half a step before the evaluation follows from the one behind it and the force, so no step has
// to store it. The first evaluation is at the start, whose velocity is half a kick away from both: before the first step
// it is the one that is stored, behind it the one that follows.
void ExplicitSolver::add_kinetic(EnergyBalance& balance) const {
  const bool before_first = state_.steps == 0, of_start = state_.steps <= 1;
  double twice_kinetic = 0, damped_behind = 0;
  for (std::size_t i = 0; i < state_.velocity.size(); ++i) {
    const double mass = model_.node_masses[i / 3], v = state_.velocity[i];
    const double half_damping = half_damping_of(i / 3);
    const double change = state_.kick * inverse_mass_[i] * state_.force[i];
    const double after = before_first ? ((1 - half_damping) * v + change) / (1 + half_damping) : v;
    const double kicked = before_first ? v : ((1 + half_damping) * v - change) / (1 - half_damping);
    const double before = of_start ? 2 * kicked - after : kicked;
    twice_kinetic += mass * before * after;
    if (!damping_rate_.empty()) damped_behind += damping_rate_[i] * mass * 0.5 * (kicked + after) * after;
  }
  balance.kinetic = 0.5 * twice_kinetic;
  if (!before_first) balance.bulk_damping = -0.5 * state_.previous_step * damped_behind;
}

}  // namespace talus::fem
