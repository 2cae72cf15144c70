#include "fem_solver/model/breaking_rope_batch.hpp"

#include <algorithm>

namespace talus::fem {

double BreakingRopeBatch::slack_energy() const noexcept {
  return ElasticRope{rope_.part().section}.slack_energy(rope_.line().reference_length());
}

void BreakingRopeBatch::internal_force(const Configuration& at, std::span<double> next,
                                       std::span<double> slots, core::Block elements) const noexcept {
  if (is_broken(at)) {
    std::fill_n(slots.begin(), 3 * this->slots(), 0.0);
    next.front() = at.memory.front();
    return;
  }
  rope_.internal_force(at, slots, elements);
  const double lost = rope_.energy(at) - slack_energy();
  const bool breaks = rope_.tension(at) > limits_.force ||
                      elongation(at) > limits_.strain * rope_.line().reference_length() ||
                      lost > limits_.work;
  next.front() = breaks ? -std::max(lost, std::numeric_limits<double>::min()) : 0;
}

void BreakingRopeBatch::stiffness_product(const Configuration& at, std::span<const double> direction,
                                          std::span<double> slots, core::Block elements) const noexcept {
  rope_.stiffness_product(at, direction, slots, elements);
  if (is_broken(at)) std::fill_n(slots.begin(), 3 * this->slots(), 0.0);
}

void BreakingRopeBatch::stiffest_product(const Configuration& at, std::span<const double> direction,
                                         std::span<double> slots, core::Block elements) const noexcept {
  rope_.stiffest_product(at, direction, slots, elements);
  if (is_broken(at)) std::fill_n(slots.begin(), 3 * this->slots(), 0.0);
}

}  // namespace talus::fem
