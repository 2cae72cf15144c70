#include "fem_solver/constraints/penalty_sliding.hpp"

namespace talus::fem {

PenaltySlide::Nodes PenaltySlide::stiffness_product(const Nodes& changes) const noexcept {
  const double t = fraction_;
  const Vector3 dw = changes.B - changes.A, dr = changes.C - changes.A;
  const double dt = between_ends() ? (w_.dot(dr) + (q_ - t * w_).dot(dw)) / w_.squaredNorm() : 0;
  const Vector3 pull = penalty_ * (dr - t * dw - dt * w_);
  const Vector3 shift = penalty_ * dt * q_;
  return {-(1 - t) * pull + shift, -t * pull - shift, pull};
}

PenaltySlide::Nodes PenaltySlide::material_product(const Nodes& changes) const noexcept {
  const double square = q_.squaredNorm();
  if (!(square > 0)) return {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  const Vector3 apart = changes.C - (1 - fraction_) * changes.A - fraction_ * changes.B;
  const Vector3 pull = (penalty_ * q_.dot(apart) / square) * q_;
  return {-(1 - fraction_) * pull, -fraction_ * pull, pull};
}

namespace {

/// Column by column.
template <class Product>
PenaltySlide::Matrix9 matrix_of(const Product& product) noexcept {
  PenaltySlide::Matrix9 K;
  for (int column = 0; column < 9; ++column) {
    Vector3 unit[3] = {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
    unit[column / 3][column % 3] = 1;
    const PenaltySlide::Nodes change = product(PenaltySlide::Nodes{unit[0], unit[1], unit[2]});
    K.col(column) << change.A, change.B, change.C;
  }
  return K;
}

}  // namespace

PenaltySlide::Matrix9 PenaltySlide::stiffness() const noexcept {
  return matrix_of([this](const Nodes& changes) { return stiffness_product(changes); });
}

PenaltySlide::Matrix9 PenaltySlide::material_stiffness() const noexcept {
  return matrix_of([this](const Nodes& changes) { return material_product(changes); });
}

}  // namespace talus::fem
