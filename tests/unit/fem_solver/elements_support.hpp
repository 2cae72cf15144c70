#pragma once

#include <Eigen/Geometry>
#include <random>
#include <span>

#include "core/vector3.hpp"

namespace talus::test {

/// Random states with a fixed seed.
class Dice {
 public:
  explicit Dice(unsigned seed) : generator_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  /// Even in its logarithm.
  double decades(double low, double high) { return std::pow(10, uniform(std::log10(low), std::log10(high))); }
  core::Vector3 vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  Eigen::Matrix3d rotation() {
    return Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))
        .normalized()
        .toRotationMatrix();
  }

 private:
  std::mt19937_64 generator_;
};

inline std::span<const double> span_of(const Eigen::VectorXd& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}

/// Turns each of the 3-vectors stacked in `stacked`.
inline Eigen::VectorXd turned(const Eigen::Matrix3d& rotation, Eigen::VectorXd stacked) {
  for (Eigen::Index i = 0; i < stacked.size(); i += 3)
    stacked.segment<3>(i) = rotation * stacked.segment<3>(i);
  return stacked;
}

}  // namespace talus::test
