#pragma once

#include <span>
#include <string>
#include <vector>

#include "fem_solver/elements/frictional_cable.hpp"
#include "fem_solver/model/configuration.hpp"
#include "fem_solver/model/rope_batch.hpp"

namespace talus::fem {

/// A part that is one rope running over its inner nodes with friction. One force slot a segment.
///
/// It remembers how much unstretched rope M each segment holds, what that pulls with, and what friction has
/// dissipated: a force is a function of the positions and of the lengths held when the last step was accepted.
/// Slip s_k at node k takes the work of the pull P = q N - u = -dU/dM that differs across it,
///
///     dD = sum_k s_k (P_(k+1) - P_k)
///
/// with P as the mean of both ends of a step, as the forces' work in the balance of a leapfrog and of the
/// trapezoidal rule is. So a rope whose friction fades dissipates nothing.
/// @see ElementBatch for the meaning of the members.
class FrictionalCableBatch {
 public:
  struct Description {
    AxialPart part;
    std::vector<double> friction;  ///< mu of each inner node; infinite: clamped. One value: of all
    double gap = 0;                ///< size of a slider (m); 0: a hundredth of the shortest segment
  };
  /// @throws core::ConfigError for a rope that closes on itself
  FrictionalCableBatch(const Description& description, const std::vector<std::array<Index, 2>>& segments,
                       std::span<const double> reference);

  static std::string called() { return "sliding rope"; }
  Index size() const { return 1; }
  Index slots() const { return line_.segments(); }
  const std::vector<std::array<Index, 2>>& cells() const { return line_.cells(); }
  template <class Visit>
  void for_each_incidence(const Visit& visit) const {
    line_.for_each_incidence(visit);
  }

  std::size_t memory_size() const { return 2 * segments() + 1; }
  void fill_initial_memory(std::span<double> memory) const;

  /// NaN where the positions are, so that the run ends with an error.
  void internal_force(const Configuration& at, std::span<double> next, std::span<double> slots,
                      core::Block) const noexcept;
  /// With the material held: the stiffest the rope can be, and symmetric.
  void stiffness_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                         core::Block) const noexcept;
  void stiffest_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                        core::Block elements) const noexcept {
    stiffness_product(at, direction, slots, elements);
  }
  void damping_product(const Configuration& at, std::span<const double> velocity, std::span<double> slots,
                       core::Block) const noexcept;
  void add_stiffness_bound(const Configuration& at, std::span<double> row_sums) const noexcept;
  double energy(const Configuration& at) const noexcept;
  void add_mass(std::span<double> node_masses) const noexcept { add_rope_mass(line_, part_, node_masses); }
  /// With the slip that follows; not symmetric.
  template <class Sink>
  void stiffness(const Configuration& at, const Sink& sink) const {
    cable_.stiffness(
        line_.chords(at.displacement), material(at),
        [&](std::size_t i, std::size_t j, const Matrix3& block) { line_.spread_block(i, j, block, sink); });
  }
  template <class Sink>
  void damping_matrix(const Configuration& at, const Sink& sink) const {
    cable_.material_stiffness(
        line_.chords(at.displacement), material(at),
        [&](std::size_t i, std::size_t j, const Matrix3& block) { line_.spread_block(i, j, block, sink); });
  }
  double dissipated(const Configuration& at) const noexcept;  ///< J

  double tension(const Configuration& at, Index segment) const noexcept;
  double stress(const Configuration& at, Index segment) const noexcept;  ///< Pa, second Piola-Kirchhoff
  double length(const Configuration& at) const noexcept;
  /// Unstretched rope that has passed the inner node behind `segment` since the start, towards the rope's end
  /// (m).
  double slip(const Configuration& at, Index segment) const noexcept;
  const RopeLine& line() const { return line_; }
  const AxialPart& part() const { return part_; }

 private:
  std::size_t segments() const noexcept { return static_cast<std::size_t>(line_.segments()); }
  /// What each segment holds (m).
  std::span<const double> material(const Configuration& at) const noexcept {
    return (at.memory.empty() ? std::span<const double>(initial_) : at.memory).first(segments());
  }

  double newly_dissipated(const Configuration& at, std::span<const double> next) const noexcept;

  AxialPart part_;
  RopeLine line_;
  RopeLaw law_;
  FrictionalCable cable_;
  std::vector<double> initial_;  ///< m; unstretched length of each segment
};

}  // namespace talus::fem
