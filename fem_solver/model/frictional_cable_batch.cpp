#include "fem_solver/model/frictional_cable_batch.hpp"

#include <algorithm>
#include <limits>

#include "core/errors.hpp"

namespace talus::fem {
namespace {

double gap_of(const FrictionalCableBatch::Description& description, const RopeLine& line) {
  return description.gap > 0 ? description.gap : default_gap(line);
}

std::vector<double> friction_of(const FrictionalCableBatch::Description& description, const RopeLine& line) {
  if (line.nodes().front() == line.nodes().back())
    throw core::ConfigError(
        "a rope with friction has two ends, but this one closes on itself; let it end beside the node it "
        "began at");
  const auto inner = static_cast<std::size_t>(line.segments()) - 1;
  return description.friction.size() == 1 ? std::vector<double>(inner, description.friction.front())
                                          : description.friction;
}

}  // namespace

FrictionalCableBatch::FrictionalCableBatch(const Description& description,
                                           const std::vector<std::array<Index, 2>>& segments,
                                           std::span<const double> reference)
    : part_(description.part),
      line_(segments, reference),
      law_(description.part.section),
      cable_({law_, friction_of(description, line_), gap_of(description, line_)}) {
  for (Index e = 0; e < line_.segments(); ++e) initial_.push_back(line_.reference_length(e));
}

void FrictionalCableBatch::fill_initial_memory(std::span<double> memory) const {
  std::ranges::copy(initial_, memory.begin());
  std::ranges::fill(memory.subspan(segments(), segments()), law_.pull_of_material(1));
  memory.back() = 0;
}

void FrictionalCableBatch::internal_force(const Configuration& at, std::span<double> next,
                                          std::span<double> slots, core::Block) const noexcept {
  const auto chords = line_.chords(at.displacement);
  const auto held = next.first(segments());
  if (!cable_.settle(chords, material(at), held)) {
    std::ranges::fill(slots.first(3 * segments()), std::numeric_limits<double>::quiet_NaN());
    if (!at.memory.empty()) std::ranges::copy(at.memory, next.begin());
    return;
  }
  for (std::size_t i = 0; i < segments(); ++i)
    next[segments() + i] = law_.pull_of_material(cable_.stretch(chords(i), held[i]));
  next.back() = dissipated(at) + newly_dissipated(at, next);
  cable_.segment_forces(chords, held,
                        [&](std::size_t i, const Vector3& force) { Vector3::Map(&slots[3 * i]) = force; });
}

double FrictionalCableBatch::newly_dissipated(const Configuration& at,
                                              std::span<const double> next) const noexcept {
  const std::size_t m = segments();
  const auto old = material(at);
  const auto pull = [&](std::size_t i) {
    return 0.5 * (next[m + i] + (at.memory.empty() ? law_.pull_of_material(1) : at.memory[m + i]));
  };
  double joules = 0, passed = 0;
  for (std::size_t k = 0; k + 1 < m; ++k) {
    passed += old[k] - next[k];
    joules += passed * (pull(k + 1) - pull(k));
  }
  return joules;
}

void FrictionalCableBatch::stiffness_product(const Configuration& at, std::span<const double> direction,
                                             std::span<double> slots, core::Block) const noexcept {
  cable_.held_stiffness_product(
      line_.chords(at.displacement), line_.differences(direction), material(at),
      [&](std::size_t i, const Vector3& force) { Vector3::Map(&slots[3 * i]) = force; });
}

void FrictionalCableBatch::damping_product(const Configuration& at, std::span<const double> velocity,
                                           std::span<double> slots, core::Block) const noexcept {
  cable_.material_product(line_.chords(at.displacement), line_.differences(velocity), material(at),
                          [&](std::size_t i, const Vector3& force) { Vector3::Map(&slots[3 * i]) = force; });
}

/// With the material held, as in stiffness_product().
void FrictionalCableBatch::add_stiffness_bound(const Configuration& at,
                                               std::span<double> row_sums) const noexcept {
  const auto chords = line_.chords(at.displacement);
  for (std::size_t i = 0; i < segments(); ++i) {
    const double held = material(at)[i], q = cable_.stretch(chords(i), held);
    const RopeSegment segment(chords(i), cable_.gap());
    const Vector3& t = segment.direction;
    add_pair_bound(line_.cells()[i],
                   law_.taut_slope(q) / held * t * t.transpose() + law_.tension(q) * segment.curvature(),
                   row_sums);
  }
}

double FrictionalCableBatch::energy(const Configuration& at) const noexcept {
  return cable_.energy(line_.chords(at.displacement), material(at));
}

double FrictionalCableBatch::dissipated(const Configuration& at) const noexcept {
  return at.memory.empty() ? 0 : at.memory.back();
}

double FrictionalCableBatch::tension(const Configuration& at, Index segment) const noexcept {
  const auto e = static_cast<std::size_t>(segment);
  return cable_.tension(line_.chords(at.displacement)(e), material(at)[e]);
}

double FrictionalCableBatch::stress(const Configuration& at, Index segment) const noexcept {
  const auto e = static_cast<std::size_t>(segment);
  return law_.stress(line_.chords(at.displacement)(e).norm() / material(at)[e]);
}

double FrictionalCableBatch::length(const Configuration& at) const noexcept {
  const auto chords = line_.chords(at.displacement);
  double sum = 0;
  for (std::size_t i = 0; i < chords.size(); ++i) sum += chords(i).norm();
  return sum;
}

double FrictionalCableBatch::slip(const Configuration& at, Index segment) const noexcept {
  double passed = 0;
  for (Index e = 0; e <= segment; ++e)
    passed += initial_[static_cast<std::size_t>(e)] - material(at)[static_cast<std::size_t>(e)];
  return passed;
}

}  // namespace talus::fem
