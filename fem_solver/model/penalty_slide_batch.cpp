#include "fem_solver/model/penalty_slide_batch.hpp"

#include <algorithm>

namespace talus::fem {
namespace {

Vector3 node_value(std::span<const double> values, Index node) {
  return Vector3::Map(&values[3 * static_cast<std::size_t>(node)]);
}

}  // namespace

PenaltySlideBatch::PenaltySlideBatch(SlideLine line, double penalty, std::span<const double> reference)
    : line_(std::move(line)), penalty_(penalty), reference_(reference.begin(), reference.end()) {
  for (const Index node : line_.sliders) cells_.push_back({node});
}

Vector3 PenaltySlideBatch::position(const Configuration& at, Index node) const noexcept {
  return node_value(reference_, node) + node_value(at.displacement, node);
}

PenaltySlideBatch::Contact PenaltySlideBatch::contact(const Configuration& at,
                                                      std::size_t slider) const noexcept {
  const auto node = [&](std::size_t k) { return position(at, line_.rope[k]); };
  const Vector3 place = position(at, line_.sliders[slider]);
  const std::size_t segment = nearest_segment(line_.rope.size() - 1, node, place).segment;
  return {segment, {{node(segment), node(segment + 1), place}, penalty_}};
}

template <class ForceOn>
void PenaltySlideBatch::fill_slots(const Configuration& at, std::span<double> slots,
                                   ForceOn&& force_on) const noexcept {
  const std::size_t sliders = line_.sliders.size();
  std::fill_n(slots.begin(), 3 * (sliders + line_.rope.size()), 0.0);
  for (std::size_t k = 0; k < sliders; ++k) {
    const Contact touched = contact(at, k);
    const PenaltySlide::Nodes force = force_on(k, touched);
    double* rope = &slots[3 * (sliders + touched.segment)];
    Vector3::Map(&slots[3 * k]) = force.C;
    Vector3::Map(rope) += force.A;
    Vector3::Map(rope + 3) += force.B;
  }
}

void PenaltySlideBatch::internal_force(const Configuration& at, std::span<double> slots,
                                       core::Block) const noexcept {
  fill_slots(at, slots, [](std::size_t, const Contact& touched) -> PenaltySlide::Nodes {
    const Vector3 force = touched.spring.slider_force();
    const double fraction = touched.spring.fraction();
    return {-(1 - fraction) * force, -fraction * force, force};
  });
}

void PenaltySlideBatch::stiffness_product(const Configuration& at, std::span<const double> direction,
                                          std::span<double> slots, core::Block) const noexcept {
  fill_slots(at, slots, [&](std::size_t k, const Contact& touched) {
    const Index* rope = &line_.rope[touched.segment];
    return touched.spring.stiffness_product({node_value(direction, rope[0]), node_value(direction, rope[1]),
                                             node_value(direction, line_.sliders[k])});
  });
}

void PenaltySlideBatch::damping_product(const Configuration& at, std::span<const double> velocity,
                                        std::span<double> slots, core::Block) const noexcept {
  fill_slots(at, slots, [&](std::size_t k, const Contact& touched) {
    const Index* rope = &line_.rope[touched.segment];
    return touched.spring.material_product({node_value(velocity, rope[0]), node_value(velocity, rope[1]),
                                            node_value(velocity, line_.sliders[k])});
  });
}

void PenaltySlideBatch::stiffest_product(const Configuration& at, std::span<const double> direction,
                                         std::span<double> slots, core::Block) const noexcept {
  fill_slots(at, slots, [&](std::size_t k, const Contact& touched) -> PenaltySlide::Nodes {
    const bool second_is_nearer = touched.spring.fraction() > 0.5;
    const Index nearest = line_.rope[touched.segment + (second_is_nearer ? 1 : 0)];
    const Vector3 pull =
        penalty_ * (node_value(direction, line_.sliders[k]) - node_value(direction, nearest));
    if (second_is_nearer) return {Vector3::Zero(), -pull, pull};
    return {-pull, Vector3::Zero(), pull};
  });
}

void PenaltySlideBatch::add_stiffness_bound(const Configuration& at,
                                            std::span<double> row_sums) const noexcept {
  for (std::size_t k = 0; k < line_.sliders.size(); ++k) {
    const std::size_t segment = contact(at, k).segment;
    for (const Index node : {line_.sliders[k], line_.rope[segment], line_.rope[segment + 1]})
      Vector3::Map(&row_sums[3 * static_cast<std::size_t>(node)]).array() += 2 * penalty_;
  }
}

double PenaltySlideBatch::energy(const Configuration& at) const noexcept {
  double sum = 0;
  for (std::size_t k = 0; k < line_.sliders.size(); ++k) sum += contact(at, k).spring.energy();
  return sum;
}

double PenaltySlideBatch::gap(const Configuration& at, std::size_t slider) const noexcept {
  return contact(at, slider).spring.gap();
}

double PenaltySlideBatch::place(const Configuration& at, std::size_t slider) const noexcept {
  const auto [nearest, spring] = contact(at, slider);
  const auto length = [&](std::size_t segment) {
    return (position(at, line_.rope[segment + 1]) - position(at, line_.rope[segment])).norm();
  };
  double sum = spring.fraction() * length(nearest);
  for (std::size_t segment = 0; segment < nearest; ++segment) sum += length(segment);
  return sum;
}

}  // namespace talus::fem
