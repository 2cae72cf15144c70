#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "fem_solver/elements/plane_contact.hpp"
#include "fem_solver/model/configuration.hpp"
#include "fem_solver/model/index.hpp"
#include "fem_solver/model/pair_incidence.hpp"

namespace talus::fem {

/// A fixed plane and the nodes that it stops. One force slot a node. Has no mass.
/// @see ElementBatch for the meaning of the members.
class ObstacleBatch {
 public:
  /// @param plane its stiffness does not count: each node has its own (N/m)
  /// @param reference node positions, 3 a node (m)
  ObstacleBatch(const PlaneContact& plane, const std::vector<Index>& nodes, std::vector<double> stiffness,
                std::span<const double> reference);

  static std::string called() { return "nodes at an obstacle"; }
  Index size() const { return static_cast<Index>(cells_.size()); }
  Index slots() const { return size(); }
  const std::vector<std::array<Index, 1>>& cells() const { return cells_; }
  template <class Visit>
  void for_each_incidence(const Visit& visit) const {
    for (Index e = 0; e < size(); ++e) visit(cells_[place(e)][0], e, +1);
  }

  std::size_t memory_size() const { return numbers * cells_.size(); }
  void fill_initial_memory(std::span<double> memory) const { std::ranges::fill(memory, 0.0); }

  void internal_force(const Configuration& at, std::span<double> next, std::span<double> slots,
                      core::Block elements) const noexcept;
  void stiffness_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                         core::Block elements) const noexcept;
  void stiffest_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                        core::Block elements) const noexcept;
  /// Across the plane, where a node touches it.
  void damping_product(const Configuration& at, std::span<const double> velocity, std::span<double> slots,
                       core::Block elements) const noexcept;
  void add_stiffness_bound(const Configuration& at, std::span<double> row_sums) const noexcept;
  double energy(const Configuration& at) const noexcept;
  double dissipated(const Configuration& at) const noexcept;  ///< J
  void add_mass(std::span<double>) const noexcept {}
  template <class Sink>
  void stiffness(const Configuration& at, const Sink& sink) const {
    for (Index e = 0; e < size(); ++e)
      sink(cells_[place(e)][0], cells_[place(e)][0], contact(e).tangent(position(at, e), memory(at, e)));
  }
  template <class Sink>
  void damping_matrix(const Configuration& at, const Sink& sink) const {
    for (Index e = 0; e < size(); ++e) sink(cells_[place(e)][0], cells_[place(e)][0], damping(at, e));
  }

  double depth(const Configuration& at, Index e) const noexcept { return contact(e).depth(position(at, e)); }
  /// Across the plane (N).
  double force(const Configuration& at, Index e) const noexcept {
    return stiffness_[place(e)] * depth(at, e);
  }

 private:
  static constexpr std::size_t numbers = 8;  ///< of memory: anchor, stretch, whether it touches, dissipated
  static std::size_t place(Index i) { return static_cast<std::size_t>(i); }
  PlaneContact contact(Index e) const noexcept;
  Vector3 position(const Configuration& at, Index e) const noexcept;
  PlaneContact::Memory memory(const Configuration& at, Index e) const noexcept;
  Matrix3 damping(const Configuration& at, Index e) const noexcept;
  Vector3 of_node(std::span<const double> values, Index e) const noexcept {
    return Vector3::Map(&values[3 * place(cells_[place(e)][0])]);
  }

  PlaneContact plane_;
  std::vector<std::array<Index, 1>> cells_;
  std::vector<double> stiffness_;  ///< N/m
  std::vector<double> reference_;  ///< m; 3 a node of this obstacle
};

}  // namespace talus::fem
