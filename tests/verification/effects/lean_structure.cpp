#include "tests/verification/effects/lean_structure.hpp"

#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "fem_solver/integration/external_force.hpp"

namespace talus::test {

using namespace fem;

template <class Batch>
LeanStructure<Batch>::LeanStructure(const Model& model, double step)
    : model_(model), elements_(std::get<Batch>(model.parts.at(0).elements)), step_(step) {
  const std::size_t values = model.reference.size();
  displacement_.assign(values, 0);
  velocity_.assign(values, 0);
  force_.assign(values, 0);
  reactions_.assign(reaction_count(model), 0);
  for (const auto& initial : model.initial_velocities)
    for (const Index node : initial.nodes) Vector3::Map(&velocity_[3 * node]) = initial.velocity;
  for (const double m : model.node_masses) inverse_mass_.insert(inverse_mass_.end(), 3, 1 / m);
  slots_.resize(3 * static_cast<std::size_t>(elements_.slots()));
  sums_.resize(static_cast<std::size_t>(core::block_count(static_cast<std::int64_t>(values))));
  const auto run_of = [](Index node, int sign) { return 2 * static_cast<std::size_t>(node) + (sign < 0); };
  incidence_begin_.assign(2 * static_cast<std::size_t>(model.nodes()) + 1, 0);
  elements_.for_each_incidence(
      [&](Index node, Index, int sign) { ++incidence_begin_[run_of(node, sign) + 1]; });
  std::partial_sum(incidence_begin_.begin(), incidence_begin_.end(), incidence_begin_.begin());
  incidence_.resize(static_cast<std::size_t>(incidence_begin_.back()));
  std::vector<Index> next(incidence_begin_.begin(), incidence_begin_.end() - 1);
  elements_.for_each_incidence(
      [&](Index node, Index slot, int sign) { incidence_[next[run_of(node, sign)]++] = 3 * slot; });
}

template <class Batch>
void LeanStructure<Batch>::step() {
  core::parallel_blocks(elements_.size(), [&](core::Block block, std::int64_t) {
    elements_.internal_force(displacement_, slots_, block);
  });
  sum_at_nodes();
  hold_supports();
  if (!std::isfinite(move_nodes())) throw std::runtime_error("velocities overflow");
  previous_step_ = step_;
}

template <class Batch>
void LeanStructure<Batch>::sum_at_nodes() noexcept {
  core::parallel_for(model_.nodes(), [&](std::int64_t node) {
    const Index* run = &incidence_begin_[2 * static_cast<std::size_t>(node)];
    Vector3 sum = Vector3::Zero();
    for (Index k = run[0]; k < run[1]; ++k) sum += Vector3::Map(&slots_[incidence_[k]]);
    for (Index k = run[1]; k < run[2]; ++k) sum -= Vector3::Map(&slots_[incidence_[k]]);
    Vector3::Map(&force_[3 * static_cast<std::size_t>(node)]) = -sum;
  });
}

template <class Batch>
void LeanStructure<Batch>::hold_supports() noexcept {
  for_each_support(model_, [&](const Support& support, std::size_t dof, std::size_t offset) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (!support.fixed[c]) continue;
      reactions_[offset + c] = -force_[dof + c];
      force_[dof + c] = 0;
    }
  });
}

template <class Batch>
double LeanStructure<Batch>::move_nodes() noexcept {
  constexpr std::int64_t width = 8;
  const double kick = 0.5 * (previous_step_ + step_);
  double* __restrict velocity = velocity_.data();
  double* __restrict displacement = displacement_.data();
  const double* __restrict force = force_.data();
  const double* __restrict inverse_mass = inverse_mass_.data();
  const auto advance = [&](std::int64_t i) {
    const double after = velocity[i] + kick * inverse_mass[i] * force[i];
    velocity[i] = after;
    displacement[i] += step_ * after;
    return after * after;
  };
  core::parallel_blocks(static_cast<std::int64_t>(velocity_.size()), [&](core::Block block, std::int64_t at) {
    std::array<double, width> lanes{};
    std::int64_t i = block.begin;
    for (; i + width <= block.end; i += width)
      for (std::int64_t lane = 0; lane < width; ++lane) lanes[lane] += advance(i + lane);
    double sum = 0;
    for (; i < block.end; ++i) sum += advance(i);
    for (const double lane : lanes) sum += lane;
    sums_[static_cast<std::size_t>(at)] = sum;
  });
  return std::accumulate(sums_.begin(), sums_.end(), 0.0);
}

template class LeanStructure<CableBatch>;
template class LeanStructure<SlidingCableBatch>;
template class LeanStructure<PlainMembraneBatch>;

}  // namespace talus::test
