#pragma once

#include <span>
#include <vector>

#include "fem_solver/elements/frictional_cable.hpp"
#include "fem_solver/model/rope_batch.hpp"

namespace talus::fem {

/// A part that is one rope running over its inner nodes with friction. One force slot a segment.
///
/// It remembers how much unstretched rope each segment holds. internal_force() finds the lengths that the
/// present positions ask for from those kept; accept() keeps them. So a force is a function of the positions
/// and of what was accepted last.
/// @see ElementBatch for the meaning of the members.
class FrictionalCableBatch {
 public:
  struct Description {
    AxialPart part;
    double friction = 0;  ///< mu of the capstan equation, > 0
    double gap = 0;       ///< size of a slider (m); 0: a hundredth of the shortest segment
  };
  FrictionalCableBatch(const Description& description, const std::vector<std::array<Index, 2>>& segments,
                       std::span<const double> reference);

  Index size() const { return 1; }
  Index slots() const { return line_.segments(); }
  const std::vector<std::array<Index, 2>>& cells() const { return line_.cells(); }
  template <class Visit>
  void for_each_incidence(const Visit& visit) const {
    line_.for_each_incidence(visit);
  }

  /// NaN where slip did not converge, so that the run ends with an error.
  void internal_force(std::span<const double> displacement, std::span<double> slots,
                      core::Block) const noexcept;
  /// With the material held: the stiffest the rope can be, and symmetric.
  void stiffness_product(std::span<const double> displacement, std::span<const double> direction,
                         std::span<double> slots, core::Block) const noexcept;
  void stiffest_product(std::span<const double> displacement, std::span<const double> direction,
                        std::span<double> slots, core::Block elements) const noexcept {
    stiffness_product(displacement, direction, slots, elements);
  }
  double energy(std::span<const double> displacement) const noexcept;
  void add_mass(std::span<double> node_masses) const noexcept {
    add_rope_mass(line_, description_.part, node_masses);
  }
  /// With the slip that follows; not symmetric.
  template <class Sink>
  void stiffness(std::span<const double> displacement, const Sink& sink) const {
    const auto chords = line_.chords(displacement);
    cable_.settle(chords, kept_, next_);
    cable_.stiffness(chords, next_, [&](std::size_t i, std::size_t j, const Matrix3& block) {
      line_.spread_block(i, j, block, sink);
    });
  }

  void accept() const noexcept;
  std::vector<double> memory() const;
  void set_memory(std::span<const double> values) const;
  std::size_t memory_size() const { return kept_.size() + 1; }
  double dissipated() const noexcept { return dissipated_; }  ///< J; up to the last accept()

  double tension(std::span<const double> displacement, Index segment) const noexcept;
  double stress(std::span<const double> displacement,
                Index segment) const noexcept;  ///< Pa, second Piola-Kirchhoff
  double length(std::span<const double> displacement) const noexcept;
  /// Unstretched rope that has passed the inner node behind `segment` since the start, towards the rope's end
  /// (m).
  double slip(Index segment) const noexcept;
  const RopeLine& line() const { return line_; }

 private:
  Description description_;
  RopeLine line_;
  RopeLaw law_;
  // The run's state, not the structure's description: changes while the model is constant.
  mutable FrictionalCable cable_;
  mutable std::vector<double> kept_, next_;  ///< m; unstretched length in each segment
  mutable double dissipated_ = 0, newly_dissipated_ = 0;
};

}  // namespace talus::fem
