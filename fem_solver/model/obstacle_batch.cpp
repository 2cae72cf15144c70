#include "fem_solver/model/obstacle_batch.hpp"

#include <utility>

namespace talus::fem {

ObstacleBatch::ObstacleBatch(const PlaneContact& plane, const std::vector<Index>& nodes,
                             std::vector<double> stiffness, std::span<const double> reference)
    : plane_(plane), stiffness_(std::move(stiffness)) {
  for (const Index node : nodes) {
    cells_.push_back({node});
    for (std::size_t c = 0; c < 3; ++c) reference_.push_back(reference[3 * place(node) + c]);
  }
}

PlaneContact ObstacleBatch::contact(Index e) const noexcept {
  PlaneContact own = plane_;
  own.stiffness = stiffness_[place(e)];
  return own;
}

Vector3 ObstacleBatch::position(const Configuration& at, Index e) const noexcept {
  return Vector3::Map(&reference_[3 * place(e)]) + of_node(at.displacement, e);
}

PlaneContact::Memory ObstacleBatch::memory(const Configuration& at, Index e) const noexcept {
  if (at.memory.empty()) return {};
  const double* m = &at.memory[numbers * place(e)];
  return {
      .anchor = {m[0], m[1], m[2]}, .stretch = {m[3], m[4], m[5]}, .touches = m[6] != 0, .dissipated = m[7]};
}

void ObstacleBatch::internal_force(const Configuration& at, std::span<double> next, std::span<double> slots,
                                   core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e) {
    const PlaneContact own = contact(e);
    const Vector3 x = position(at, e);
    const PlaneContact::Memory after = own.follow(x, memory(at, e));
    double* m = &next[numbers * place(e)];
    std::ranges::copy(after.anchor, m);
    std::ranges::copy(after.stretch, m + 3);
    m[6] = after.touches ? 1 : 0;
    m[7] = after.dissipated;
    Vector3::Map(&slots[3 * place(e)]) = own.pressing(x) + own.stiffness * after.stretch;
  }
}

void ObstacleBatch::stiffness_product(const Configuration& at, std::span<const double> direction,
                                      std::span<double> slots, core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e)
    Vector3::Map(&slots[3 * place(e)]) =
        contact(e).tangent(position(at, e), memory(at, e)) * of_node(direction, e);
}

void ObstacleBatch::stiffest_product(const Configuration&, std::span<const double> direction,
                                     std::span<double> slots, core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e)
    Vector3::Map(&slots[3 * place(e)]) = contact(e).stiffest() * of_node(direction, e);
}

Matrix3 ObstacleBatch::damping(const Configuration& at, Index e) const noexcept {
  if (!(depth(at, e) > 0)) return Matrix3::Zero();
  return stiffness_[place(e)] * plane_.normal * plane_.normal.transpose();
}

void ObstacleBatch::damping_product(const Configuration& at, std::span<const double> velocity,
                                    std::span<double> slots, core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e)
    Vector3::Map(&slots[3 * place(e)]) = damping(at, e) * of_node(velocity, e);
}

void ObstacleBatch::add_stiffness_bound(const Configuration&, std::span<double> row_sums) const noexcept {
  for (Index e = 0; e < size(); ++e)
    Vector3::Map(&row_sums[3 * place(cells_[place(e)][0])]) +=
        contact(e).stiffest().cwiseAbs().rowwise().sum();
}

double ObstacleBatch::energy(const Configuration& at) const noexcept {
  double sum = 0;
  for (Index e = 0; e < size(); ++e) sum += contact(e).energy(position(at, e), memory(at, e));
  return sum;
}

double ObstacleBatch::dissipated(const Configuration& at) const noexcept {
  double sum = 0;
  for (Index e = 0; e < size(); ++e) sum += memory(at, e).dissipated;
  return sum;
}

}  // namespace talus::fem
