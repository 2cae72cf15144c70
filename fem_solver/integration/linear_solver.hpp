#pragma once

#include <Eigen/Core>
#include <memory>

#include "fem_solver/assembly/sparse_stiffness.hpp"

namespace talus::fem {

/// Sparse Cholesky factorisation (CHOLMOD) of symmetric matrices that all have the same
/// pattern, unless it is told otherwise.
class LinearSolver {
 public:
  /// @param rows_in_blocks from so many rows on the factor is made of dense blocks. Below, CHOLMOD starts four threads
  /// for each of thousands of small ones, which takes longer than column by column and steals the cores of the coupled
  /// processes.
  explicit LinearSolver(Eigen::Index rows_in_blocks = 100000);
  ~LinearSolver();

  /// @param matrix lower half. @returns false where it is not positive definite, or so nearly singular that a
  /// solution would be noise
  bool factorise(const SparseMatrix& matrix);
  /// The next matrix may have another pattern.
  void forget_pattern();
  /// Factorises matrix + shift I with the smallest shift, in powers of ten from 1e-8 of the largest diagonal
  /// entry, that makes it positive definite. @returns the shift; 0: none was needed
  double factorise_shifted(SparseMatrix matrix);
  /// @pre factorised
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  [[noreturn]] void report_no_factor(double value) const;
  struct Factor;
  Eigen::Index rows_in_blocks_;
  std::unique_ptr<Factor> factor_;
};

}  // namespace talus::fem
