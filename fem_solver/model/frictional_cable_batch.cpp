#include "fem_solver/model/frictional_cable_batch.hpp"

#include <algorithm>
#include <limits>

namespace talus::fem {
namespace {

double gap_of(const FrictionalCableBatch::Description& description, const RopeLine& line) {
  return description.gap > 0 ? description.gap : default_gap(line);
}

}  // namespace

FrictionalCableBatch::FrictionalCableBatch(const Description& description,
                                           const std::vector<std::array<Index, 2>>& segments,
                                           std::span<const double> reference)
    : description_(description),
      line_(segments, reference),
      law_(description.part.section),
      cable_({law_, description.friction, gap_of(description, line_)},
             static_cast<std::size_t>(line_.segments())) {
  for (Index e = 0; e < line_.segments(); ++e) kept_.push_back(line_.reference_length(e));
  next_ = kept_;
}

void FrictionalCableBatch::internal_force(std::span<const double> displacement, std::span<double> slots,
                                          core::Block) const noexcept {
  const auto chords = line_.chords(displacement);
  if (!cable_.settle(chords, kept_, next_)) {
    std::fill_n(slots.begin(), 3 * kept_.size(), std::numeric_limits<double>::quiet_NaN());
    return;
  }
  newly_dissipated_ = cable_.energy(chords, kept_) - cable_.energy(chords, next_);
  cable_.segment_forces(chords, next_,
                        [&](std::size_t i, const Vector3& force) { Vector3::Map(&slots[3 * i]) = force; });
}

void FrictionalCableBatch::stiffness_product(std::span<const double> displacement,
                                             std::span<const double> direction, std::span<double> slots,
                                             core::Block) const noexcept {
  cable_.held_stiffness_product(
      line_.chords(displacement), line_.differences(direction), kept_,
      [&](std::size_t i, const Vector3& force) { Vector3::Map(&slots[3 * i]) = force; });
}

double FrictionalCableBatch::energy(std::span<const double> displacement) const noexcept {
  return cable_.energy(line_.chords(displacement), kept_);
}

void FrictionalCableBatch::accept() const noexcept {
  kept_ = next_;
  dissipated_ += newly_dissipated_;
  newly_dissipated_ = 0;
}

std::vector<double> FrictionalCableBatch::memory() const {
  std::vector<double> values = kept_;
  values.push_back(dissipated_);
  return values;
}

void FrictionalCableBatch::set_memory(std::span<const double> values) const {
  std::copy_n(values.begin(), kept_.size(), kept_.begin());
  next_ = kept_;
  dissipated_ = values[kept_.size()];
  newly_dissipated_ = 0;
}

double FrictionalCableBatch::tension(std::span<const double> displacement, Index segment) const noexcept {
  const auto e = static_cast<std::size_t>(segment);
  return cable_.tension(line_.chords(displacement)(e), kept_[e]);
}

double FrictionalCableBatch::stress(std::span<const double> displacement, Index segment) const noexcept {
  const auto e = static_cast<std::size_t>(segment);
  return law_.stress(line_.chords(displacement)(e).norm() / kept_[e]);
}

double FrictionalCableBatch::length(std::span<const double> displacement) const noexcept {
  const auto chords = line_.chords(displacement);
  double sum = 0;
  for (std::size_t i = 0; i < chords.size(); ++i) sum += chords(i).norm();
  return sum;
}

double FrictionalCableBatch::slip(Index segment) const noexcept {
  double passed = 0;
  for (Index e = 0; e <= segment; ++e)
    passed += line_.reference_length(e) - kept_[static_cast<std::size_t>(e)];
  return passed;
}

}  // namespace talus::fem
