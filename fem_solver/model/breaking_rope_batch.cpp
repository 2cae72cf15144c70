#include "fem_solver/model/breaking_rope_batch.hpp"

#include <algorithm>

namespace talus::fem {

template <class Rope>
double BreakingRope<Rope>::slack_energy() const noexcept {
  return ElasticRope{rope_.part().section}.slack_energy(rope_.line().reference_length());
}

template <class Rope>
double BreakingRope<Rope>::tension_of(const Configuration& at, Index segment) const noexcept {
  if (is_broken(at)) return 0;
  if constexpr (Remembers<Rope>)
    return rope_.tension(own(at), segment);
  else
    return rope_.tension(own(at));
}

template <class Rope>
double BreakingRope<Rope>::largest_tension(const Configuration& own) const noexcept {
  if constexpr (Remembers<Rope>) {
    double largest = 0;
    for (Index e = 0; e < rope_.line().segments(); ++e) largest = std::max(largest, rope_.tension(own, e));
    return largest;
  } else {
    return rope_.tension(own);
  }
}

template <class Rope>
double BreakingRope<Rope>::dissipated(const Configuration& at) const noexcept {
  if (is_broken(at)) return -at.memory.back();
  if constexpr (Remembers<Rope>)
    return rope_.dissipated(own(at));
  else
    return 0;
}

template <class Rope>
void BreakingRope<Rope>::internal_force(const Configuration& at, std::span<double> next,
                                        std::span<double> slots, core::Block elements) const noexcept {
  if (is_broken(at)) {
    std::fill_n(slots.begin(), 3 * this->slots(), 0.0);
    std::ranges::copy(at.memory, next.begin());
    return;
  }
  const auto own_next = next.first(own_memory());
  if constexpr (Remembers<Rope>)
    rope_.internal_force(own(at), own_next, slots, elements);
  else
    rope_.internal_force(own(at), slots, elements);
  const Configuration now(at.displacement, own_next);
  const double stored = rope_.energy(now) - slack_energy();
  const bool breaks = largest_tension(now) > limits_.force ||
                      elongation(at) > limits_.strain * rope_.line().reference_length() ||
                      stored > limits_.work;
  double lost = stored;
  if constexpr (Remembers<Rope>) lost += rope_.dissipated(now);
  next.back() = breaks ? -std::max(lost, std::numeric_limits<double>::min()) : 0;
}

template <class Rope>
void BreakingRope<Rope>::stiffness_product(const Configuration& at, std::span<const double> direction,
                                           std::span<double> slots, core::Block elements) const noexcept {
  rope_.stiffness_product(own(at), direction, slots, elements);
  if (is_broken(at)) std::fill_n(slots.begin(), 3 * this->slots(), 0.0);
}

template <class Rope>
void BreakingRope<Rope>::damping_product(const Configuration& at, std::span<const double> velocity,
                                         std::span<double> slots, core::Block elements) const noexcept {
  rope_.damping_product(own(at), velocity, slots, elements);
  if (is_broken(at)) std::fill_n(slots.begin(), 3 * this->slots(), 0.0);
}

template <class Rope>
void BreakingRope<Rope>::stiffest_product(const Configuration& at, std::span<const double> direction,
                                          std::span<double> slots, core::Block elements) const noexcept {
  rope_.stiffest_product(own(at), direction, slots, elements);
  if (is_broken(at)) std::fill_n(slots.begin(), 3 * this->slots(), 0.0);
}

template class BreakingRope<SlidingCableBatch>;
template class BreakingRope<FrictionalCableBatch>;

}  // namespace talus::fem
