#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "fem_solver/elements/rope_segments.hpp"
#include "fem_solver/materials/ring_law.hpp"
#include "fem_solver/model/configuration.hpp"
#include "fem_solver/model/index.hpp"
#include "fem_solver/model/pair_incidence.hpp"

namespace talus::fem {

/// The closed polygons of a part: each is one ring, that runs freely through its nodes, where neighbours touch it.
///
///     p = sum of l_i      N = N(p)      f_k = N T_k,  T_k = t_(k-1) - t_k      K = (dN/dp) T T^T + sum N d2l_i/dx2
///
/// as a SlidingCable has it, with the law of a ring (RingLaw) and around in a circle. One force slot a side. Each ring
/// remembers one number, as its law says, and weighs the same at each of its nodes.
/// @see ElementBatch for the meaning of the members; elements are rings, cells their sides.
template <class Law>
class RingBatch {
 public:
  struct Description {
    Law law;
    double mass = 0;            ///< kg; of a ring
    double inner_diameter = 0;  ///< m
  };
  /// @param segments side by side around each ring: a ring ends where it is back at the node it began with
  /// @param reference node positions, 3 a node (m)
  /// @throws core::ConfigError where segments do not close to rings, or a ring's polygon is longer than the ring itself
  RingBatch(Description description, std::vector<std::array<Index, 2>> segments,
            std::span<const double> reference);

  static std::string called() { return Law::called(); }
  Index size() const { return static_cast<Index>(perimeters_.size()); }
  Index slots() const { return static_cast<Index>(cells_.size()); }
  const std::vector<std::array<Index, 2>>& cells() const { return cells_; }
  template <class Visit>
  void for_each_incidence(const Visit& visit) const {
    for_each_pair_incidence(cells_, visit);
  }

  std::size_t memory_size() const { return perimeters_.size(); }
  void fill_initial_memory(std::span<double> memory) const { std::ranges::fill(memory, 0.0); }

  void internal_force(const Configuration& at, std::span<double> next, std::span<double> slots,
                      core::Block rings) const noexcept;
  void stiffness_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                         core::Block rings) const noexcept;
  /// At the slope of the law's stretch, to which it may unload in any step.
  void stiffest_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                        core::Block rings) const noexcept;
  void damping_product(const Configuration& at, std::span<const double> velocity, std::span<double> slots,
                       core::Block rings) const noexcept;
  void add_stiffness_bound(const Configuration& at, std::span<double> row_sums) const;
  double energy(const Configuration& at) const noexcept;
  double dissipated(const Configuration& at) const noexcept;  ///< J
  void add_mass(std::span<double> node_masses) const noexcept;
  template <class Sink>
  void stiffness(const Configuration& at, const Sink& sink) const {
    for (Index e = 0; e < size(); ++e) spread(at, e, along(at, e), sink);
  }
  template <class Sink>
  void damping_matrix(const Configuration& at, const Sink& sink) const {
    for (Index e = 0; e < size(); ++e) spread(at, e, material(at, e), sink);
  }

  /// N; along the ring, the same in all its sides.
  double axial_force(const Configuration& at, Index ring) const noexcept { return respond(at, ring).force; }
  /// Growth of the perimeter (m).
  double elongation(const Configuration& at, Index ring) const noexcept {
    return perimeter(at, ring) - perimeters_[place(ring)];
  }
  /// Whether it has broken in a step accepted before.
  template <class Own = Law>
  requires requires { Own::is_broken(0.0); }
  bool is_broken(const Configuration& at, Index ring) const noexcept {
    return Own::is_broken(kept(at, ring));
  }
  /// What the law keeps of the steps accepted.
  double kept(const Configuration& at, Index ring) const noexcept {
    return at.memory.empty() ? 0 : at.memory[place(ring)];
  }
  Index element_of(Index cell) const noexcept { return ring_of_[place(cell)]; }
  Index first_cell(Index ring) const noexcept { return begin_[place(ring)]; }

 private:
  static std::size_t place(Index i) { return static_cast<std::size_t>(i); }
  /// Of the force along a ring.
  struct Along {
    double tension, slope;  ///< N, N/m
  };
  AxialResponse respond(const Configuration& at, Index ring) const noexcept {
    return description_.law.respond({perimeter(at, ring), perimeters_[place(ring)]}, kept(at, ring));
  }
  Along along(const Configuration& at, Index ring) const noexcept;
  /// What resists a change of the perimeter, as a rate's force does.
  Along material(const Configuration& at, Index ring) const noexcept;
  Along stiffest(const Configuration& at, Index ring) const noexcept;

  Vector3 difference(std::span<const double> values, Index cell) const noexcept {
    const auto [near, far] = cells_[place(cell)];
    return Vector3::Map(&values[3 * place(far)]) - Vector3::Map(&values[3 * place(near)]);
  }
  RopeSegment side(const Configuration& at, Index cell) const noexcept {
    return {Vector3::Map(&reference_[3 * place(cell)]) + difference(at.displacement, cell), gap_};
  }
  double perimeter(const Configuration& at, Index ring) const noexcept;
  void product(const Configuration& at, Index ring, const Along& along, std::span<const double> changes,
               std::span<double> slots) const noexcept;
  template <class Sink>
  void spread(const Configuration& at, Index ring, const Along& along, const Sink& sink) const {
    for (Index i = begin_[place(ring)]; i < begin_[place(ring) + 1]; ++i) {
      const RopeSegment row = side(at, i);
      for (Index j = begin_[place(ring)]; j < begin_[place(ring) + 1]; ++j) {
        Matrix3 block = along.slope * row.direction * side(at, j).direction.transpose();
        if (i == j) block += along.tension * row.curvature();
        spread_pair_block(cells_[place(i)], cells_[place(j)], block, sink);
      }
    }
  }

  Description description_;
  double gap_ = 0;  ///< m; size of the ring that slides along another
  std::vector<std::array<Index, 2>> cells_;
  std::vector<double> reference_;   ///< m; chords, 3 a side
  std::vector<Index> begin_;        ///< first side of each ring, and the number of all
  std::vector<Index> ring_of_;      ///< of each side
  std::vector<double> perimeters_;  ///< m; of each ring's polygon in the reference state
};

using PlainRingBatch = RingBatch<RingLaw>;
using BreakingRingBatch = RingBatch<Breaking<RingLaw>>;
extern template class RingBatch<RingLaw>;
extern template class RingBatch<Breaking<RingLaw>>;

}  // namespace talus::fem
