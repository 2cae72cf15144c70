#include "fem_solver/assembly/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel.hpp"

namespace talus::fem {
namespace {

/// visit(node, slot, sign) for the slots of all parts.
template <class Visit>
void for_each_incidence(const Model& model, const std::vector<std::size_t>& slot_begin, const Visit& visit) {
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const auto begin = static_cast<Index>(slot_begin[p]);
    std::visit(
        [&](const auto& batch) {
          batch.for_each_incidence(
              [&](Index node, Index slot, int sign) { visit(node, begin + slot, sign); });
        },
        model.parts[p].elements);
  }
}

}  // namespace

std::vector<std::string> stages_of(const Model& model) {
  std::vector<std::string> stages;
  for (const auto& part : model.parts) stages.push_back("elements_of_" + part.name);
  for (const char* stage : {"sum_at_nodes", "other_forces_and_supports", "motion_of_nodes",
                            "sliding_constraints", "works_for_the_ledger", "everything_else"})
    stages.push_back(stage);
  return stages;
}

Assembly::Assembly(const Model& model) : model_(model) {
  std::size_t slots = 0;
  for (const auto& part : model.parts) {
    slot_begin_.push_back(slots);
    slots +=
        static_cast<std::size_t>(std::visit([](const auto& batch) { return batch.slots(); }, part.elements));
  }
  slot_begin_.push_back(slots);
  slots_.resize(3 * slots);
  next_memory_ = initial_memory(model);
  memory_begin_.push_back(0);
  for (const auto& part : model.parts)
    memory_begin_.push_back(
        memory_begin_.back() +
        std::visit([](const auto& batch) { return memory_size_of(batch); }, part.elements));

  const auto run_of = [](Index node, int sign) { return 2 * static_cast<std::size_t>(node) + (sign < 0); };
  incidence_begin_.assign(2 * static_cast<std::size_t>(model.nodes()) + 1, 0);
  for_each_incidence(model, slot_begin_,
                     [&](Index node, Index, int sign) { ++incidence_begin_[run_of(node, sign) + 1]; });
  std::partial_sum(incidence_begin_.begin(), incidence_begin_.end(), incidence_begin_.begin());
  incidence_.resize(static_cast<std::size_t>(incidence_begin_.back()));
  std::vector<Index> next(incidence_begin_.begin(), incidence_begin_.end() - 1);
  for_each_incidence(model, slot_begin_, [&](Index node, Index slot, int sign) {
    incidence_[static_cast<std::size_t>(next[run_of(node, sign)]++)] = 3 * slot;
  });
}

std::span<double> Assembly::slots_of(std::size_t part) noexcept {
  return std::span(slots_).subspan(3 * slot_begin_[part], 3 * (slot_begin_[part + 1] - slot_begin_[part]));
}

/// compute(batch, its configuration, what it remembers next, its slots, range of elements) for every part.
template <class Compute>
void Assembly::compute_slots(const Configuration& at, const Compute& compute) noexcept {
  for (std::size_t p = 0; p < model_.parts.size(); ++p) {
    const std::size_t begin = memory_begin_[p], size = memory_begin_[p + 1] - begin;
    const Configuration own(at.displacement, at.memory.empty() ? at.memory : at.memory.subspan(begin, size));
    const auto next = std::span(next_memory_).subspan(begin, size);
    std::visit(
        [&](const auto& batch) {
          core::parallel_blocks(batch.size(), [&](core::Block elements, std::int64_t) {
            compute(batch, own, next, slots_of(p), elements);
          });
        },
        model_.parts[p].elements);
    core::lap(clock_, p);
  }
}

void Assembly::internal_force(const Configuration& at, std::span<double> force) noexcept {
  start_step();  // whoever asks out of a step does not have the time before counted
  compute_slots(at, [](const auto& batch, const Configuration& own, std::span<double> next,
                       std::span<double> slots, core::Block elements) {
    if constexpr (Remembers<std::decay_t<decltype(batch)>>)
      batch.internal_force(own, next, slots, elements);
    else
      batch.internal_force(own, slots, elements);
  });
  gather(-1, force);
  lap(StepStage::sum_at_nodes);
}

void Assembly::stiffness_product(const Configuration& at, std::span<const double> direction,
                                 std::span<double> product) noexcept {
  compute_slots(at,
                [&](const auto& batch, const Configuration& own, std::span<double>, std::span<double> slots,
                    core::Block elements) { batch.stiffness_product(own, direction, slots, elements); });
  gather(1, product);
}

void Assembly::damping_force(const Configuration& at, std::span<const double> velocity,
                             std::span<double> force) noexcept {
  const double most = largest_stiffness_damping(model_);
  for_each_part(model_, at, [&](std::size_t p, const auto& batch, const Configuration& own) {
    const auto slots = slots_of(p);
    const double share = model_.parts[p].stiffness_damping / most;
    if (share > 0)
      core::parallel_blocks(batch.size(), [&](core::Block elements, std::int64_t) {
        batch.damping_product(own, velocity, slots, elements);
      });
    if (share == 1) return;  // as of all parts where the structure has one damping
    core::parallel_for(static_cast<std::int64_t>(slots.size()),
                       [&](std::int64_t i) { slots[i] = share > 0 ? share * slots[i] : 0; });
  });
  gather(most, force);
}

void Assembly::stiffest_product(const Configuration& at, std::span<const double> direction,
                                std::span<double> product) noexcept {
  compute_slots(at,
                [&](const auto& batch, const Configuration& own, std::span<double>, std::span<double> slots,
                    core::Block elements) { batch.stiffest_product(own, direction, slots, elements); });
  gather(1, product);
}

double Assembly::largest_element_force() const noexcept {
  double largest = 0;
  for (const double value : slots_) largest = std::max(largest, std::abs(value));
  return largest;
}

void Assembly::gather(double factor, std::span<double> sums) const noexcept {
  core::parallel_for(model_.nodes(), [&](std::int64_t node) {
    const Index* run = &incidence_begin_[2 * static_cast<std::size_t>(node)];
    Vector3 sum = Vector3::Zero();
    for (Index k = run[0]; k < run[1]; ++k) sum += Vector3::Map(&slots_[incidence_[k]]);
    for (Index k = run[1]; k < run[2]; ++k) sum -= Vector3::Map(&slots_[incidence_[k]]);
    Vector3::Map(&sums[3 * static_cast<std::size_t>(node)]) = factor * sum;
  });
}

}  // namespace talus::fem
