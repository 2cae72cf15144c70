#include "fem_solver/model/user_batch.hpp"

#include <utility>

namespace talus::fem {

template <std::size_t nodes>
UserBatch<nodes>::UserBatch(const MakeUserElement& make, const std::vector<double>& parameters,
                            std::vector<Cell> cells, std::span<const double> reference)
    : cells_(std::move(cells)) {
  for (const Cell& cell : cells_) {
    Positions& own = reference_.emplace_back();
    for (std::size_t i = 0; i < nodes; ++i)
      for (std::size_t c = 0; c < 3; ++c) own[3 * i + c] = reference[3 * place(cell[i]) + c];
    elements_.push_back(make(own, parameters));
  }
}

template <std::size_t nodes>
auto UserBatch<nodes>::positions(const Configuration& at, Index e) const noexcept -> Positions {
  Positions now = reference_[place(e)];
  for (std::size_t i = 0; i < nodes; ++i)
    for (std::size_t c = 0; c < 3; ++c) now[3 * i + c] += at.displacement[3 * place(cells_[place(e)][i]) + c];
  return now;
}

template <std::size_t nodes>
auto UserBatch<nodes>::stiffness_of(const Configuration& at, Index e) const -> Values {
  Values K;
  elements_[place(e)]->stiffness(positions(at, e), {K.data(), values * values});
  return K;
}

template <std::size_t nodes>
void UserBatch<nodes>::internal_force(const Configuration& at, std::span<double> slots,
                                      core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e)
    elements_[place(e)]->force(positions(at, e), slots.subspan(values * place(e), values));
}

template <std::size_t nodes>
void UserBatch<nodes>::stiffness_product(const Configuration& at, std::span<const double> direction,
                                         std::span<double> slots, core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e) {
    Eigen::Matrix<double, static_cast<int>(values), 1> along;
    for (std::size_t i = 0; i < nodes; ++i)
      along.template segment<3>(3 * static_cast<int>(i)) =
          Vector3::Map(&direction[3 * place(cells_[place(e)][i])]);
    using Column = Eigen::Matrix<double, static_cast<int>(values), 1>;
    Column::Map(&slots[values * place(e)]) = stiffness_of(at, e) * along;
  }
}

template <std::size_t nodes>
void UserBatch<nodes>::add_stiffness_bound(const Configuration& at, std::span<double> row_sums) const {
  for (Index e = 0; e < size(); ++e) {
    const Values K = stiffness_of(at, e);
    for (std::size_t i = 0; i < nodes; ++i)
      for (std::size_t j = 0; j < nodes; ++j)
        Vector3::Map(&row_sums[3 * place(cells_[place(e)][i])]) += block(K, i, j).cwiseAbs().rowwise().sum();
  }
}

template <std::size_t nodes>
double UserBatch<nodes>::energy(const Configuration& at, Index e) const noexcept {
  return elements_[place(e)]->energy(positions(at, e));
}

template <std::size_t nodes>
double UserBatch<nodes>::energy(const Configuration& at) const noexcept {
  double sum = 0;
  for (Index e = 0; e < size(); ++e) sum += energy(at, e);
  return sum;
}

template <std::size_t nodes>
void UserBatch<nodes>::add_mass(std::span<double> node_masses) const noexcept {
  for (Index e = 0; e < size(); ++e) {
    std::array<double, nodes> own{};
    elements_[place(e)]->masses(own);
    for (std::size_t i = 0; i < nodes; ++i) node_masses[place(cells_[place(e)][i])] += own[i];
  }
}

template class UserBatch<2>;
template class UserBatch<3>;

}  // namespace talus::fem
