#include "fem_solver/integration/linear_solver.hpp"

#include <cholmod.h>

#include <algorithm>

#include "core/errors.hpp"

namespace talus::fem {
namespace {

/// Below this ratio of smallest to largest pivot a direction carries nothing but rounding.
constexpr double least_reciprocal_condition = 1e-15;

/// CHOLMOD's view of Eigen's compressed columns; owns nothing.
cholmod_sparse view(const SparseMatrix& matrix) {
  cholmod_sparse v{};
  v.nrow = static_cast<std::size_t>(matrix.rows());
  v.ncol = static_cast<std::size_t>(matrix.cols());
  v.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  v.p = const_cast<int*>(matrix.outerIndexPtr());
  v.i = const_cast<int*>(matrix.innerIndexPtr());
  v.x = const_cast<double*>(matrix.valuePtr());
  v.stype = -1;  // symmetric, lower half stored
  v.itype = CHOLMOD_INT;
  v.xtype = CHOLMOD_REAL;
  v.dtype = CHOLMOD_DOUBLE;
  v.sorted = 1;
  v.packed = 1;
  return v;
}

cholmod_dense view(const Eigen::VectorXd& vector) {
  cholmod_dense v{};
  v.nrow = v.nzmax = v.d = static_cast<std::size_t>(vector.size());
  v.ncol = 1;
  v.x = const_cast<double*>(vector.data());
  v.xtype = CHOLMOD_REAL;
  v.dtype = CHOLMOD_DOUBLE;
  return v;
}

}  // namespace

// CHOLMOD directly and not through Eigen, whose wrapper does not let the condition of the factor be asked
// for.
struct LinearSolver::Factor {
  Factor() {
    cholmod_start(&common);
    common.print = 0;  // a matrix that is not positive definite is an answer here, not a message
    common.final_ll = 1;
  }
  ~Factor() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  cholmod_common common{};
  cholmod_factor* factor = nullptr;
};

LinearSolver::LinearSolver(Eigen::Index rows_in_blocks)
    : rows_in_blocks_(rows_in_blocks), factor_(std::make_unique<Factor>()) {}
LinearSolver::~LinearSolver() = default;

bool LinearSolver::factorise(const SparseMatrix& matrix) {
  if (matrix.rows() == 0) return true;
  cholmod_sparse a = view(matrix);
  if (!factor_->factor) {
    factor_->common.supernodal = matrix.rows() < rows_in_blocks_ ? CHOLMOD_SIMPLICIAL : CHOLMOD_SUPERNODAL;
    factor_->factor = cholmod_analyze(&a, &factor_->common);
  }
  cholmod_factorize(&a, factor_->factor, &factor_->common);
  return factor_->common.status == CHOLMOD_OK &&
         cholmod_rcond(factor_->factor, &factor_->common) > least_reciprocal_condition;
}

void LinearSolver::forget_pattern() {
  cholmod_free_factor(&factor_->factor, &factor_->common);
}

double LinearSolver::factorise_shifted(SparseMatrix matrix) {
  if (factorise(matrix)) return 0;
  const double largest_entry = matrix.diagonal().cwiseAbs().maxCoeff();
  const double largest = largest_entry > 0 ? largest_entry : 1;  // nothing is stiff: any shift is as good
  double shift = 0;
  constexpr double most = 1e8;  // far above what makes any matrix of numbers positive definite
  for (double next = 1e-8 * largest; next <= most * largest; next *= 10) {
    matrix.diagonal().array() += next - shift;
    shift = next;
    if (factorise(matrix)) return shift;
  }
  report_no_factor(largest);
}

void LinearSolver::report_no_factor(double value) const {
  const bool no_memory = factor_->common.status == CHOLMOD_OUT_OF_MEMORY;
  throw core::NumericalError(
      {.what = no_memory ? "there is not enough memory for the factors of the stiffness matrix"
                         : "the stiffness matrix cannot be factorised, however it is shifted",
       .entity = "largest entry of its diagonal (N/m)",
       .value = value});
}

Eigen::VectorXd LinearSolver::solve(const Eigen::VectorXd& right) const {
  if (right.size() == 0) return right;
  cholmod_dense b = view(right);
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor_->factor, &b, &factor_->common);
  if (x == nullptr) report_no_factor(0);
  Eigen::VectorXd solution = Eigen::VectorXd::Map(static_cast<const double*>(x->x), right.size());
  cholmod_free_dense(&x, &factor_->common);
  return solution;
}

}  // namespace talus::fem
