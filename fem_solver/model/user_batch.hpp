#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "fem_solver/elements/axial.hpp"
#include "fem_solver/elements/user_element.hpp"
#include "fem_solver/model/configuration.hpp"
#include "fem_solver/model/index.hpp"

namespace talus::fem {

/// The elements of a part that a program has brought along, between 2 or 3 nodes each. One force slot a node of each.
/// @see ElementBatch for the meaning of the members.
template <std::size_t nodes>
class UserBatch {
 public:
  using Cell = std::array<Index, nodes>;
  /// @param reference node positions, 3 a node (m). @throws what `make` throws
  UserBatch(const MakeUserElement& make, const std::vector<double>& parameters, std::vector<Cell> cells,
            std::span<const double> reference);

  static std::string called() { return "elements of this program"; }
  Index size() const { return static_cast<Index>(cells_.size()); }
  Index slots() const { return static_cast<Index>(nodes) * size(); }
  const std::vector<Cell>& cells() const { return cells_; }
  template <class Visit>
  void for_each_incidence(const Visit& visit) const {
    Index slot = 0;
    for (const Cell& cell : cells_)
      for (const Index node : cell) visit(node, slot++, +1);
  }

  void internal_force(const Configuration& at, std::span<double> slots, core::Block elements) const noexcept;
  void stiffness_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                         core::Block elements) const noexcept;
  /// An element says no more than its stiffness at a state.
  void stiffest_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                        core::Block elements) const noexcept {
    stiffness_product(at, direction, slots, elements);
  }
  /// An element does not say which part of its stiffness is its material's.
  void damping_product(const Configuration& at, std::span<const double> velocity, std::span<double> slots,
                       core::Block elements) const noexcept {
    stiffness_product(at, velocity, slots, elements);
  }
  template <class Sink>
  void damping_matrix(const Configuration& at, const Sink& sink) const {
    stiffness(at, sink);
  }
  void add_stiffness_bound(const Configuration& at, std::span<double> row_sums) const;
  double energy(const Configuration& at) const noexcept;
  double energy(const Configuration& at, Index e) const noexcept;
  void add_mass(std::span<double> node_masses) const noexcept;
  template <class Sink>
  void stiffness(const Configuration& at, const Sink& sink) const {
    for (Index e = 0; e < size(); ++e) {
      const Values K = stiffness_of(at, e);
      for (std::size_t i = 0; i < nodes; ++i)
        for (std::size_t j = 0; j < nodes; ++j)
          sink(cells_[place(e)][i], cells_[place(e)][j], Matrix3(block(K, i, j)));
    }
  }

 private:
  static constexpr std::size_t values = 3 * nodes;
  using Values = Eigen::Matrix<double, static_cast<int>(values), static_cast<int>(values), Eigen::RowMajor>;
  using Positions = std::array<double, values>;
  static std::size_t place(Index i) { return static_cast<std::size_t>(i); }
  static Matrix3 block(const Values& K, std::size_t i, std::size_t j) {
    return K.template block<3, 3>(3 * static_cast<int>(i), 3 * static_cast<int>(j));
  }
  Positions positions(const Configuration& at, Index e) const noexcept;
  Values stiffness_of(const Configuration& at, Index e) const;

  std::vector<std::shared_ptr<const UserElement>> elements_;
  std::vector<Cell> cells_;
  std::vector<Positions> reference_;  ///< m
};

using UserLineBatch = UserBatch<2>;
using UserTriangleBatch = UserBatch<3>;
extern template class UserBatch<2>;
extern template class UserBatch<3>;

}  // namespace talus::fem
