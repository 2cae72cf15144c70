#include "fem_solver/assembly/sparse_stiffness.hpp"

#include <algorithm>

#include "fem_solver/constraints/held_directions.hpp"

namespace talus::fem {
namespace {

template <class Sink>
void for_each_block(const Model& model, const Configuration& at, const Sink& sink) {
  for_each_part(model, at, [&](std::size_t, const auto& batch, const Configuration& own) {
    batch.stiffness(own, sink);
  });
}

/// visit(row direction, column direction, number) of a block's nine numbers.
template <class Visit>
void for_each_number(Index row, Index column, const Matrix3& block, const Visit& visit) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      visit(3 * static_cast<std::size_t>(row) + static_cast<std::size_t>(i),
            3 * static_cast<std::size_t>(column) + static_cast<std::size_t>(j), block(i, j));
}

}  // namespace

Equations::Equations(const Model& model) : number_(model.reference.size(), 0) {
  for (const HeldDirection& h : held_directions(model)) number_[h.direction] = -1;
  for (std::size_t direction = 0; direction < number_.size(); ++direction) {
    if (number_[direction] < 0) continue;
    number_[direction] = count();
    free_.push_back(static_cast<Index>(direction));
  }
}

Eigen::VectorXd Equations::gather(std::span<const double> values) const {
  Eigen::VectorXd gathered(count());
  for (Index k = 0; k < count(); ++k) gathered[k] = values[static_cast<std::size_t>(direction(k))];
  return gathered;
}

void Equations::scatter_add(double factor, const Eigen::VectorXd& solution, std::span<double> values) const {
  for (Index k = 0; k < count(); ++k) values[static_cast<std::size_t>(direction(k))] += factor * solution[k];
}

SparseStiffness::SparseStiffness(const Model& model, const Equations& equations)
    : model_(model), equations_(equations) {
  std::vector<std::pair<Index, Index>>
      entries;  // row and column of every number, lower half; (-1, -1): supported
  const std::vector<double> rest(model.reference.size(), 0.0);
  for_each_block(model, rest, [&](Index row, Index column, const Matrix3& block) {
    for_each_number(row, column, block, [&](std::size_t i, std::size_t j, double) {
      const Index a = equations.of(i), b = equations.of(j);
      entries.emplace_back(a < 0 || b < 0 ? std::pair<Index, Index>{-1, -1}
                                          : std::pair{std::max(a, b), std::min(a, b)});
    });
  });
  std::vector<Eigen::Triplet<double>> pattern;
  for (Index k = 0; k < equations.count(); ++k) pattern.emplace_back(k, k, 0.0);
  for (const auto& [row, column] : entries)
    if (row >= 0) pattern.emplace_back(row, column, 0.0);
  matrix_.resize(equations.count(), equations.count());
  matrix_.setFromTriplets(pattern.begin(), pattern.end());

  const auto place_of = [&](Index row, Index column) {
    const Index* begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
    const Index* end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column + 1];
    return static_cast<Index>(std::lower_bound(begin, end, row) - matrix_.innerIndexPtr());
  };
  place_.reserve(entries.size());
  for (const auto& [row, column] : entries) place_.push_back(row < 0 ? -1 : place_of(row, column));
  for (Index k = 0; k < equations.count(); ++k) diagonal_place_.push_back(place_of(k, k));
}

/// @param for_each_block calls what it is given with (row, column, block, factor)
template <class ForEachBlock>
void SparseStiffness::add(const ForEachBlock& for_each_block) {
  double* values = matrix_.valuePtr();
  std::size_t next = 0;
  for_each_block([&](Index row, Index column, const Matrix3& block, double factor) {
    for_each_number(row, column, block, [&](std::size_t i, std::size_t j, double number) {
      const Index place = place_[next++];
      if (place >= 0) values[place] += (i == j ? factor : 0.5 * factor) * number;
    });
  });
}

const SparseMatrix& SparseStiffness::add_damping(const Configuration& at, double factor) {
  add([&](const auto& take) {
    for_each_part(model_, at, [&](std::size_t p, const auto& batch, const Configuration& own) {
      const double own_factor = factor * model_.parts[p].stiffness_damping;
      batch.damping_matrix(
          own, [&](Index row, Index column, const Matrix3& block) { take(row, column, block, own_factor); });
    });
  });
  return matrix_;
}

const SparseMatrix& SparseStiffness::assemble(const Configuration& at, double factor,
                                              std::span<const double> diagonal) {
  double* values = matrix_.valuePtr();
  std::fill(values, values + matrix_.nonZeros(), 0.0);
  add([&](const auto& take) {
    for_each_block(model_, at,
                   [&](Index row, Index column, const Matrix3& block) { take(row, column, block, factor); });
  });
  for (Index k = 0; k < equations_.count(); ++k)
    values[diagonal_place_[static_cast<std::size_t>(k)]] +=
        diagonal[static_cast<std::size_t>(equations_.direction(k))];
  return matrix_;
}

}  // namespace talus::fem
