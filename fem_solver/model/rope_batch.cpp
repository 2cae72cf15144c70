#include "fem_solver/model/rope_batch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.hpp"

namespace talus::fem {
namespace {

std::string place(std::span<const double> reference, Index node) {
  const double* x = &reference[3 * static_cast<std::size_t>(node)];
  return fmt::format("({:g}, {:g}, {:g}) m", x[0], x[1], x[2]);
}

}  // namespace

RopeLine::RopeLine(const std::vector<std::array<Index, 2>>& segments, std::span<const double> reference)
    : cells_(segments) {
  if (cells_.empty()) throw core::ConfigError("a sliding cable needs at least one segment");
  nodes_.push_back(cells_.front()[0]);
  for (const auto& [near, far] : cells_) {
    if (near != nodes_.back())
      throw core::ConfigError(
          fmt::format("a sliding cable is one line from end to end, but after {} it goes on at {}",
                      place(reference, nodes_.back()), place(reference, near)));
    nodes_.push_back(far);
    const Vector3 chord = Vector3::Map(&reference[3 * static_cast<std::size_t>(far)]) -
                          Vector3::Map(&reference[3 * static_cast<std::size_t>(near)]);
    if (chord.isZero(0))
      throw core::ConfigError(
          fmt::format("two nodes of a sliding cable coincide at {}", place(reference, near)));
    reference_.insert(reference_.end(), chord.begin(), chord.end());
  }
}

double RopeLine::reference_length() const {
  double sum = 0;
  for (Index e = 0; e < segments(); ++e) sum += reference_length(e);
  return sum;
}

void add_rope_mass(const RopeLine& line, const AxialPart& part, std::span<double> node_masses) noexcept {
  for (Index e = 0; e < line.segments(); ++e) {
    const double half = 0.5 * part.density * part.section.area * line.reference_length(e);
    for (const Index node : line.cells()[static_cast<std::size_t>(e)])
      node_masses[static_cast<std::size_t>(node)] += half;
  }
}

double default_gap(const RopeLine& line) {
  double shortest = line.reference_length(0);
  for (Index e = 1; e < line.segments(); ++e) shortest = std::min(shortest, line.reference_length(e));
  return 0.01 * shortest;
}

SlidingCableBatch::SlidingCableBatch(const AxialPart& part, double gap,
                                     const std::vector<std::array<Index, 2>>& segments,
                                     std::span<const double> reference)
    : part_(part),
      line_(segments, reference),
      cable_{RopeLaw(part.section), line_.reference_length(), gap > 0 ? gap : default_gap(line_)} {}

namespace {

auto into(std::span<double> slots) noexcept {
  return [slots](std::size_t i, const Vector3& force) { Vector3::Map(&slots[3 * i]) = force; };
}

}  // namespace

void SlidingCableBatch::internal_force(const Configuration& at, std::span<double> slots,
                                       core::Block) const noexcept {
  cable_.segment_forces(line_.chords(at.displacement), into(slots));
}

void SlidingCableBatch::stiffness_product(const Configuration& at, std::span<const double> direction,
                                          std::span<double> slots, core::Block) const noexcept {
  cable_.stiffness_product(line_.chords(at.displacement), line_.differences(direction), into(slots));
}

void SlidingCableBatch::stiffest_product(const Configuration& at, std::span<const double> direction,
                                         std::span<double> slots, core::Block) const noexcept {
  cable_.taut_stiffness_product(line_.chords(at.displacement), line_.differences(direction), into(slots));
}

void SlidingCableBatch::damping_product(const Configuration& at, std::span<const double> velocity,
                                        std::span<double> slots, core::Block) const noexcept {
  cable_.material_product(line_.chords(at.displacement), line_.differences(velocity), into(slots));
}

/// The stretching of the whole rope is one number times T T^T, the turning of each segment a matter of its two nodes.
void SlidingCableBatch::add_stiffness_bound(const Configuration& at, std::span<double> row_sums) const {
  const auto chords = line_.chords(at.displacement);
  std::vector<Vector3> pulls(line_.nodes().size(), Vector3::Zero());  // T
  for (std::size_t i = 0; i < chords.size(); ++i) {
    const RopeSegment segment(chords(i), cable_.gap);
    pulls[i] -= segment.direction;
    pulls[i + 1] += segment.direction;
    add_pair_bound(line_.cells()[i], cable_.tension(chords) * segment.curvature(), row_sums);
  }
  double all = 0;
  for (const Vector3& pull : pulls) all += pull.lpNorm<1>();
  const double slope =
      cable_.law.taut_slope(cable_.length(chords) / cable_.reference_length) / cable_.reference_length;
  for (std::size_t k = 0; k < pulls.size(); ++k)
    Vector3::Map(&row_sums[3 * static_cast<std::size_t>(line_.nodes()[k])]) +=
        slope * all * pulls[k].cwiseAbs();
}

double SlidingCableBatch::stress(const Configuration& at) const noexcept {
  return cable_.law.stress(cable_.length(line_.chords(at.displacement)) / cable_.reference_length);
}

}  // namespace talus::fem
