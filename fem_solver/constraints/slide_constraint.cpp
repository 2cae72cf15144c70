#include "fem_solver/constraints/slide_constraint.hpp"

#include <cmath>

namespace talus::fem {

SlideConstraint::SlideConstraint(const Nodes& nodes) noexcept {
  const Vector3 d = nodes.B - nodes.A, r = nodes.C - nodes.A;
  d.cwiseAbs().maxCoeff(&pivot);
  slaves = {(pivot + 1) % 3, (pivot + 2) % 3};
  length = d[pivot];
  fraction = r[pivot] / length;
  for (std::size_t i = 0; i < 2; ++i) {
    slopes[i] = d[slaves[i]] / length;
    offsets[i] = r[slaves[i]] - fraction * d[slaves[i]];
  }
}

SlideConstraint::Row SlideConstraint::row(std::size_t follower) const noexcept {
  const double t = fraction, slope = slopes[follower];
  return {slaves[follower], {1 - t, t, slope, -slope * (1 - t), -slope * t}, -offsets[follower]};
}

SlideConstraint::Condensation SlideConstraint::condensation() const noexcept {
  Condensation L = Condensation::Zero();
  L.topLeftCorner<6, 6>().setIdentity();
  L(6 + pivot, 6) = 1;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto [slave, weights, constant] = row(i);
    L(6 + slave, slave) = weights[0];
    L(6 + slave, 3 + slave) = weights[1];
    L(6 + slave, 6) = weights[2];
    L(6 + slave, pivot) = weights[3];
    L(6 + slave, 3 + pivot) = weights[4];
  }
  return L;
}

// By the chain rule from the derivatives with respect to q = (r_a, d_a, d_b), of which each is a difference of
// two of the nine directions.
SlideConstraint::Curvature SlideConstraint::curvature(const std::array<double, 2>& pulls) const noexcept {
  Curvature sum = Curvature::Zero();
  for (std::size_t i = 0; i < 2; ++i) {
    const double slope = slopes[i];
    Eigen::Matrix3d by_q;
    by_q << 0, -slope, 1,  //
        -slope, 2 * fraction * slope, -fraction, 1, -fraction, 0;
    Eigen::Matrix<double, 3, 9> q = Eigen::Matrix<double, 3, 9>::Zero();
    q(0, pivot) = q(1, pivot) = q(2, slaves[i]) = -1;
    q(0, 6 + pivot) = q(1, 3 + pivot) = q(2, 3 + slaves[i]) = 1;
    sum += pulls[i] / length * (q.transpose() * by_q * q);
  }
  return sum;
}

double SlideConstraint::violation() const noexcept {
  // The offset vector has no pivot component; its part along the line does not count.
  const double along = (slopes[0] * offsets[0] + slopes[1] * offsets[1]);
  const double square = offsets[0] * offsets[0] + offsets[1] * offsets[1];
  return std::sqrt(
      std::max(0.0, square - along * along / (1 + slopes[0] * slopes[0] + slopes[1] * slopes[1])));
}

}  // namespace talus::fem
