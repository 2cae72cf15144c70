#include "fem_solver/integration/static_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/program/log.hpp"
#include "fem_solver/integration/mechanism.hpp"

namespace talus::fem {
namespace {

constexpr std::size_t most_nodes_named = 4;

}  // namespace

StaticSolver::StaticSolver(const Model& model, Assembly& assembly, const StaticOptions& options,
                           const State& start)
    : Integrator(model, start),
      model_(model),
      assembly_(assembly),
      options_(options),
      held_(held_directions(model)),
      newton_(model) {
  static_cast<State&>(state_) = start;
  std::ranges::fill(state_.velocity, 0.0);
  state_.reactions.assign(reaction_count(model), 0);
  external_.assign(model.reference.size(), 0);
}

LoadTime StaticSolver::load_time(double time) const {
  return {.time = options_.tables_at.value_or(time), .ramp = time / options_.end};
}

void StaticSolver::advance(double time, double length) {
  assembly_.start_step();
  reports_.clear();
  if (steps_ == 0) start(time);
  double share = std::min(length, options_.step);
  const double end = time + length, smallest = smallest_share_of_step * share;
  for (double now = time; now < end - 0.5 * smallest;) {
    const double next = now + share > end - 0.5 * smallest ? end : now + share;
    const StaticState before = state_;
    if (equilibrate(next)) {
      account(before, {load_time(now), load_time(next)});
      now = next;
      continue;
    }
    state_ = before;
    share *= 0.5;
    if (share < smallest) report_failure(next);
  }
  check_for_mechanisms(end);
  assembly_.lap(StepStage::everything_else);
}

void StaticSolver::archive(core::StateArchive& archive) {
  fem::archive(archive, static_cast<State&>(state_));
  archive.values("reactions", state_.reactions);
  fem::archive(archive, state_.works);
}

/// What supports bear before anything has moved, so that their first work is booked whole.
void StaticSolver::start(double time) {
  std::vector<double> sum(model_.reference.size());
  std::ranges::fill(external_, 0.0);
  add_external_force(model_, interface_, load_time(time), external_);
  residual(state_.displacement, sum);
  note_reactions(sum);
  if (!record_) return;
  record_->note_elements(time, state_.configuration(), assembly_.next_memory(), state_.record);
  record_->note_supports(time, state_.reactions, state_.record);
}

void StaticSolver::note_reactions(std::span<const double> sum) {
  for (const HeldDirection& h : held_) state_.reactions[h.reaction] = -sum[h.direction];
}

bool StaticSolver::equilibrate(double time) {
  ++steps_;
  const LoadTime when = load_time(time);
  place_supports(held_, when, state_.displacement);
  std::ranges::fill(external_, 0.0);
  add_external_force(model_, interface_, when, external_);
  reports_.push_back(newton_.solve(system(), options_.newton, state_.displacement));
  return reports_.back().converged;
}

NewtonSystem StaticSolver::system() {
  return {.residual = [this](std::span<const double> u, std::span<double> r) { residual(u, r); },
          .force_scale = [this] { return force_scale_; },
          .memory = state_.memory,
          .stiffness_factor = 1,
          .diagonal = std::vector<double>(model_.reference.size(), 0.0)};
}

void StaticSolver::residual(std::span<const double> displacement, std::span<double> residual) {
  assembly_.lap(StepStage::everything_else);
  assembly_.internal_force({displacement, state_.memory}, residual);
  force_scale_ = assembly_.largest_element_force();
  for (std::size_t i = 0; i < residual.size(); ++i) {
    residual[i] += external_[i];
    force_scale_ = std::max(force_scale_, std::abs(external_[i]));
  }
}

/// Reactions, and the works along the straight line between two equilibria.
void StaticSolver::account(const StaticState& before, const LoadSpan& span) {
  std::vector<double> sum(model_.reference.size()), change(model_.reference.size());
  residual(state_.displacement, sum);
  if (record_)
    record_->note_elements(span.after.time, state_.configuration(), assembly_.next_memory(), state_.record);
  std::ranges::copy(assembly_.next_memory(), state_.memory.begin());
  newton_.slides().carry_over(sum);
  std::ranges::transform(state_.displacement, before.displacement, change.begin(), std::minus<>{});
  for (const HeldDirection& h : held_) {
    const double force = -sum[h.direction];
    state_.works.supports += 0.5 * (before.reactions[h.reaction] + force) * change[h.direction];
    state_.reactions[h.reaction] = force;
  }
  add_works(model_, interface_, span, change, state_.works);
  if (record_) record_->note_supports(span.after.time, state_.reactions, state_.record);
}

EnergyBalance StaticSolver::balance() {
  EnergyBalance balance;
  balance.elastic = elastic_by_parts(model_, state_.configuration());
  balance.dissipated = dissipated_by_parts(model_, state_.configuration());
  balance.gravity = -state_.works.gravity;
  balance.loads = state_.works.loads;
  balance.supports = state_.works.supports;
  balance.interface = state_.works.interface;
  return balance;
}

void StaticSolver::check_for_mechanisms(double time) {
  const SoftestMotion softest = softest_motion(newton_.tangent(system(), state_.displacement));
  if (softest.kind == SoftestMotion::Kind::stiff) return;
  const std::string nodes = nodes_that_move(softest.motion);
  if (softest.kind == SoftestMotion::Kind::unstable) {
    core::log_warning(
        fmt::format("the equilibrium at {:.6g} s is unstable: the least push moves {}", time, nodes));
    return;
  }
  throw core::NumericalError(
      {.what = "the structure has an unsupported mechanism, a motion that nothing resists",
       .entity = "stiffness over the largest, of " + nodes,
       .step = steps_,
       .time = time,
       .value = softest.relative_stiffness,
       .last_output_time = last_output_time});
}

/// The nodes that move most, with the direction of their motion.
std::string StaticSolver::nodes_that_move(const Eigen::VectorXd& motion) const {
  std::vector<double> nodal(model_.reference.size(), 0.0);
  newton_.equations().scatter_add(1, motion, nodal);
  std::vector<Index> order(static_cast<std::size_t>(model_.nodes()));
  for (Index i = 0; i < model_.nodes(); ++i) order[static_cast<std::size_t>(i)] = i;
  const auto move_of = [&](Index node) {
    return Vector3(Vector3::Map(&nodal[3 * static_cast<std::size_t>(node)]));
  };
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](Index node) { return move_of(node).squaredNorm(); });
  std::string text;
  for (const Index node : order) {
    if (move_of(node).norm() < 0.1 * move_of(order.front()).norm()) break;
    const Vector3 direction = move_of(node).normalized();
    text += fmt::format("{}{} along ({:.2f}, {:.2f}, {:.2f})", text.empty() ? "" : "; ",
                        node_name(model_, node), direction.x(), direction.y(), direction.z());
    if (node == order[std::min(order.size(), most_nodes_named) - 1]) break;
  }
  return text;
}

void StaticSolver::report_failure(double time) const {
  throw core::NumericalError(
      {.what = "Newton's iteration does not converge, even for 1/1024 of the load step",
       .entity = "relative residual of " + node_name(model_, reports_.back().worst_direction / 3),
       .step = steps_,
       .time = time,
       .value = reports_.back().residuals.back(),
       .last_output_time = last_output_time});
}

}  // namespace talus::fem
