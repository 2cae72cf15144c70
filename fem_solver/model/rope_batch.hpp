#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "fem_solver/elements/sliding_cable.hpp"
#include "fem_solver/model/index.hpp"
#include "fem_solver/model/two_node_batch.hpp"

namespace talus::fem {

/// The nodes of a rope, in their order along it, and the chords between them.
class RopeLine {
 public:
  /// @param reference node positions, 3 a node (m)
  /// @throws core::ConfigError where the segments do not follow each other from one end to the other, or a
  /// node comes twice in a row at the same place
  RopeLine(const std::vector<std::array<Index, 2>>& segments, std::span<const double> reference);

  Index segments() const { return static_cast<Index>(cells_.size()); }
  Index node(Index k) const { return nodes_[static_cast<std::size_t>(k)]; }
  const std::vector<Index>& nodes() const { return nodes_; }
  const std::vector<std::array<Index, 2>>& cells() const { return cells_; }
  double reference_length(Index segment) const { return reference_chord(segment).norm(); }
  double reference_length() const;

  /// Differences of nodal values along each segment: displacements, velocities.
  struct Differences {
    const RopeLine& line;
    std::span<const double> values;
    std::size_t size() const noexcept { return line.cells_.size(); }
    Vector3 operator()(std::size_t segment) const noexcept {
      const auto [near, far] = line.cells_[segment];
      return Vector3::Map(&values[3 * static_cast<std::size_t>(far)]) -
             Vector3::Map(&values[3 * static_cast<std::size_t>(near)]);
    }
  };
  /// Current chords at a displacement.
  struct Chords {
    Differences displacements;
    std::size_t size() const noexcept { return displacements.size(); }
    Vector3 operator()(std::size_t segment) const noexcept {
      return displacements.line.reference_chord(static_cast<Index>(segment)) + displacements(segment);
    }
  };
  Differences differences(std::span<const double> values) const noexcept { return {*this, values}; }
  Chords chords(std::span<const double> displacement) const noexcept { return {differences(displacement)}; }

  template <class Visit>
  void for_each_incidence(const Visit& visit) const {
    for_each_pair_incidence(cells_, visit);
  }
  /// From derivatives of segment forces by chords to blocks by nodes: sink(row node, column node, block).
  template <class Sink>
  void spread_block(std::size_t row, std::size_t column, const Matrix3& block, const Sink& sink) const {
    spread_pair_block(cells_[row], cells_[column], block, sink);
  }

 private:
  Vector3 reference_chord(Index segment) const noexcept {
    return Vector3::Map(&reference_[3 * static_cast<std::size_t>(segment)]);
  }

  std::vector<Index> nodes_;
  std::vector<std::array<Index, 2>> cells_;
  std::vector<double> reference_;  ///< m; chords, 3 a segment
};

/// A hundredth of the shortest segment (m).
double default_gap(const RopeLine& line);

/// Half of each segment's mass at either of its nodes (kg).
void add_rope_mass(const RopeLine& line, const AxialPart& part, std::span<double> node_masses) noexcept;

/// A part that is one sliding cable without friction. One force slot a segment.
/// @see ElementBatch for the meaning of the members.
class SlidingCableBatch {
 public:
  /// @param gap size of a slider (m); 0: a hundredth of the shortest segment
  SlidingCableBatch(const AxialPart& part, double gap, const std::vector<std::array<Index, 2>>& segments,
                    std::span<const double> reference);

  static std::string called() { return "sliding rope"; }
  Index size() const { return 1; }
  Index slots() const { return line_.segments(); }
  const std::vector<std::array<Index, 2>>& cells() const { return line_.cells(); }
  template <class Visit>
  void for_each_incidence(const Visit& visit) const {
    line_.for_each_incidence(visit);
  }

  void internal_force(const Configuration& at, std::span<double> slots, core::Block) const noexcept;
  void stiffness_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                         core::Block) const noexcept;
  /// As if the rope were taut.
  void stiffest_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                        core::Block) const noexcept;
  void damping_product(const Configuration& at, std::span<const double> velocity, std::span<double> slots,
                       core::Block) const noexcept;
  void add_stiffness_bound(const Configuration& at, std::span<double> row_sums) const;
  double energy(const Configuration& at) const noexcept {
    return cable_.energy(line_.chords(at.displacement));
  }
  void add_mass(std::span<double> node_masses) const noexcept { add_rope_mass(line_, part_, node_masses); }
  template <class Sink>
  void stiffness(const Configuration& at, const Sink& sink) const {
    cable_.stiffness(line_.chords(at.displacement), [&](std::size_t i, std::size_t j, const Matrix3& block) {
      line_.spread_block(i, j, block, sink);
    });
  }

  template <class Sink>
  void damping_matrix(const Configuration& at, const Sink& sink) const {
    cable_.material_stiffness(
        line_.chords(at.displacement),
        [&](std::size_t i, std::size_t j, const Matrix3& block) { line_.spread_block(i, j, block, sink); });
  }

  /// The same in every segment (N).
  double tension(const Configuration& at) const noexcept {
    return cable_.tension(line_.chords(at.displacement));
  }
  double length(const Configuration& at) const noexcept {
    return cable_.length(line_.chords(at.displacement));
  }
  double stress(const Configuration& at) const noexcept;  ///< Pa, second Piola-Kirchhoff
  const RopeLine& line() const { return line_; }
  const AxialPart& part() const { return part_; }

 private:
  AxialPart part_;
  RopeLine line_;
  SlidingCable cable_;
};

}  // namespace talus::fem
