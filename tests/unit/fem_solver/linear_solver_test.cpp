// Matrices with known solutions, factorised column by column and in dense blocks.
#include "fem_solver/integration/linear_solver.hpp"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

using namespace talus::fem;

namespace {

constexpr Eigen::Index never = 1000000, always = 0;

/// Lower half of the five-point Laplacian on a square of `side` by `side` points, plus `added` on the diagonal. Its
/// least eigenvalue is 4 - 4 cos(pi/(side + 1)) + added.
SparseMatrix laplacian(int side, double added) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < side * side; ++i) {
    entries.emplace_back(i, i, 4 + added);
    if (i % side + 1 < side) entries.emplace_back(i + 1, i, -1);
    if (i + side < side * side) entries.emplace_back(i + side, i, -1);
  }
  SparseMatrix matrix(side * side, side * side);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::VectorXd random_vector(Eigen::Index size) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return value(random); });
}

}  // namespace

TEST_CASE("a solution solves the equations it was asked for, by columns and by blocks") {
  constexpr int side = 40;
  const SparseMatrix matrix = laplacian(side, 0);
  const Eigen::VectorXd solution = random_vector(matrix.rows());
  const Eigen::VectorXd right = matrix.selfadjointView<Eigen::Lower>() * solution;
  for (const Eigen::Index rows_in_blocks : {never, always}) {
    LinearSolver solver(rows_in_blocks);
    REQUIRE(solver.factorise(matrix));
    CHECK((solver.solve(right) - solution).norm() < 1e-11 * solution.norm());  // condition 700
    REQUIRE(solver.factorise(laplacian(side, 1)));  // the same pattern with other numbers
    CHECK((solver.solve(right + solution) - solution).norm() < 1e-12 * solution.norm());
  }
}

TEST_CASE("a matrix with one negative direction is refused, by columns and by blocks, and shifted past it") {
  constexpr int side = 10;
  const double least = 4 - 4 * std::cos(M_PI / (side + 1));
  for (const Eigen::Index rows_in_blocks : {never, always}) {
    LinearSolver solver(rows_in_blocks);
    CHECK(solver.factorise(laplacian(side, -0.999 * least)));
    CHECK_FALSE(solver.factorise(laplacian(side, -1.001 * least)));
    const double shift = solver.factorise_shifted(laplacian(side, -1.001 * least));
    CHECK(shift > 0.001 * least);
    CHECK(shift < 10 * 0.001 * least);  // in powers of ten
  }
}

TEST_CASE("a singular matrix is refused, by columns and by blocks") {
  SparseMatrix matrix(3, 3);  // three masses in a row, held by nothing: they move together without force
  const std::vector<Eigen::Triplet<double>> entries{{0, 0, 1}, {1, 0, -1}, {1, 1, 2}, {2, 1, -1}, {2, 2, 1}};
  matrix.setFromTriplets(entries.begin(), entries.end());
  for (const Eigen::Index rows_in_blocks : {never, always}) {
    LinearSolver solver(rows_in_blocks);
    CHECK_FALSE(solver.factorise(matrix));
  }
}
