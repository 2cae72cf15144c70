#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "fem_solver/model/model.hpp"

namespace talus::fem {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Numbers the directions that are free to move; supported ones have no equation.
class Equations {
 public:
  explicit Equations(const Model& model);
  Index count() const { return static_cast<Index>(free_.size()); }
  /// -1 where the direction is supported.
  Index of(std::size_t direction) const { return number_[direction]; }
  /// The direction (3 node + 0, 1, 2) of an equation.
  Index direction(Index equation) const { return free_[static_cast<std::size_t>(equation)]; }

  Eigen::VectorXd gather(std::span<const double> values) const;
  /// values += factor * solution, at the free directions.
  void scatter_add(double factor, const Eigen::VectorXd& solution, std::span<double> values) const;

 private:
  std::vector<Index> number_, free_;
};

/// The tangent stiffness of all parts as a sparse matrix of the free directions, lower half. Elements give
/// their blocks in the same order at every state, so where each number belongs is found once. A tangent that
/// is not symmetric (wrinkle direction `principal` on an orthotropic sheet, rope friction) is replaced by its
/// symmetric half, which costs Newton its quadratic convergence, not its root.
class SparseStiffness {
 public:
  SparseStiffness(const Model& model, const Equations& equations);

  /// factor * d2U/du2 + diagonal. @param diagonal one a direction, 3 a node
  const SparseMatrix& assemble(const Configuration& at, double factor, std::span<const double> diagonal);
  /// The last matrix plus factor * what resists strain rates, by each part's stiffness damping.
  const SparseMatrix& add_damping(const Configuration& at, double factor);

 private:
  template <class ForEachBlock>
  void add(const ForEachBlock& for_each_block);

  const Model& model_;
  const Equations& equations_;
  SparseMatrix matrix_;
  std::vector<Index> place_;  ///< of every number of every block; -1: belongs to a supported direction
  std::vector<Index> diagonal_place_;  ///< of every equation
};

}  // namespace talus::fem
