#include "fem_solver/model/penalty_slide_batch.hpp"

#include <algorithm>

namespace talus::fem {

PenaltySlideBatch::PenaltySlideBatch(SlideLine line, double penalty, std::span<const double> reference)
    : line_(std::move(line)), penalty_(penalty), reference_(reference.begin(), reference.end()) {
  for (const Index node : line_.sliders) cells_.push_back({node});
}

Vector3 PenaltySlideBatch::position(std::span<const double> displacement, Index node) const noexcept {
  const auto at = 3 * static_cast<std::size_t>(node);
  return Vector3::Map(&reference_[at]) + Vector3::Map(&displacement[at]);
}

PenaltySlideBatch::Contact PenaltySlideBatch::find(std::span<const double> displacement,
                                                   std::size_t slider) const noexcept {
  const auto node = [&](std::size_t k) { return position(displacement, line_.rope[k]); };
  return {
      nearest_segment(line_.rope.size() - 1, node, position(displacement, line_.sliders[slider])).segment};
}

PenaltySlide PenaltySlideBatch::spring(std::span<const double> displacement, const Contact& contact,
                                       std::size_t slider) const noexcept {
  return {{position(displacement, line_.rope[contact.segment]),
           position(displacement, line_.rope[contact.segment + 1]),
           position(displacement, line_.sliders[slider])},
          penalty_};
}

void PenaltySlideBatch::internal_force(std::span<const double> displacement, std::span<double> slots,
                                       core::Block) const noexcept {
  const std::size_t sliders = line_.sliders.size();
  std::fill_n(slots.begin(), 3 * (sliders + line_.rope.size()), 0.0);
  for (std::size_t k = 0; k < sliders; ++k) {
    const Contact contact = find(displacement, k);
    const PenaltySlide slide = spring(displacement, contact, k);
    const Vector3 force = slide.slider_force();
    double* rope = &slots[3 * (sliders + contact.segment)];
    Vector3::Map(&slots[3 * k]) = force;
    Vector3::Map(rope) -= (1 - slide.fraction()) * force;
    Vector3::Map(rope + 3) -= slide.fraction() * force;
  }
}

void PenaltySlideBatch::stiffness_product(std::span<const double> displacement,
                                          std::span<const double> direction, std::span<double> slots,
                                          core::Block) const noexcept {
  const std::size_t sliders = line_.sliders.size();
  std::fill_n(slots.begin(), 3 * (sliders + line_.rope.size()), 0.0);
  const auto change = [&](Index node) {
    return Vector3(Vector3::Map(&direction[3 * static_cast<std::size_t>(node)]));
  };
  for (std::size_t k = 0; k < sliders; ++k) {
    const Contact contact = find(displacement, k);
    const auto product =
        spring(displacement, contact, k)
            .stiffness_product({change(line_.rope[contact.segment]), change(line_.rope[contact.segment + 1]),
                                change(line_.sliders[k])});
    double* rope = &slots[3 * (sliders + contact.segment)];
    Vector3::Map(&slots[3 * k]) = product.C;
    Vector3::Map(rope) += product.A;
    Vector3::Map(rope + 3) += product.B;
  }
}

void PenaltySlideBatch::stiffest_product(std::span<const double> displacement,
                                         std::span<const double> direction, std::span<double> slots,
                                         core::Block) const noexcept {
  const std::size_t sliders = line_.sliders.size();
  std::fill_n(slots.begin(), 3 * (sliders + line_.rope.size()), 0.0);
  const auto change = [&](Index node) {
    return Vector3::Map(&direction[3 * static_cast<std::size_t>(node)]);
  };
  for (std::size_t k = 0; k < sliders; ++k) {
    const Contact contact = find(displacement, k);
    const double fraction = spring(displacement, contact, k).fraction();
    const std::size_t nearest = contact.segment + (fraction > 0.5 ? 1 : 0);
    const Vector3 pull = penalty_ * (change(line_.sliders[k]) - change(line_.rope[nearest]));
    Vector3::Map(&slots[3 * k]) = pull;
    Vector3::Map(&slots[3 * (sliders + nearest)]) -= pull;
  }
}

double PenaltySlideBatch::energy(std::span<const double> displacement) const noexcept {
  double sum = 0;
  for (std::size_t k = 0; k < line_.sliders.size(); ++k)
    sum += spring(displacement, find(displacement, k), k).energy();
  return sum;
}

double PenaltySlideBatch::gap(std::span<const double> displacement, std::size_t slider) const noexcept {
  return spring(displacement, find(displacement, slider), slider).gap();
}

double PenaltySlideBatch::place(std::span<const double> displacement, std::size_t slider) const noexcept {
  const Contact contact = find(displacement, slider);
  const auto length = [&](std::size_t segment) {
    return (position(displacement, line_.rope[segment + 1]) - position(displacement, line_.rope[segment]))
        .norm();
  };
  double sum = spring(displacement, contact, slider).fraction() * length(contact.segment);
  for (std::size_t segment = 0; segment < contact.segment; ++segment) sum += length(segment);
  return sum;
}

}  // namespace talus::fem
