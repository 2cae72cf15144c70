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

PenaltySlide::Matrix9 PenaltySlide::stiffness() const noexcept {
  Matrix9 K;
  for (int column = 0; column < 9; ++column) {
    Vector3 unit[3] = {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
    unit[column / 3][column % 3] = 1;
    const Nodes change = stiffness_product({unit[0], unit[1], unit[2]});
    K.col(column) << change.A, change.B, change.C;
  }
  return K;
}

}  // namespace talus::fem
