#pragma once

#include <Eigen/Core>
#include <numeric>
#include <vector>

#include "fem_solver/elements/frictional_cable.hpp"
#include "fem_solver/elements/sliding_cable.hpp"
#include "tests/unit/fem_solver/elements_support.hpp"

/// Ropes as stacked node positions, for tests of the kernels alone.
namespace talus::test {

inline fem::StackedChords chords_of(const Eigen::VectorXd& x) {
  return fem::StackedChords(span_of(x));
}

inline std::vector<double> segment_lengths(const Eigen::VectorXd& x) {
  const fem::StackedChords chords = chords_of(x);
  std::vector<double> lengths;
  for (std::size_t i = 0; i < chords.size(); ++i) lengths.push_back(chords(i).norm());
  return lengths;
}

/// Nodal forces from forces of the segments: the farther node +, the nearer one -.
template <class ForEachSegment>
Eigen::VectorXd nodal_forces(Eigen::Index coordinates, const ForEachSegment& for_each_segment) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(coordinates);
  for_each_segment([&](std::size_t i, const core::Vector3& force) {
    f.segment<3>(3 * static_cast<Eigen::Index>(i) + 3) += force;
    f.segment<3>(3 * static_cast<Eigen::Index>(i)) -= force;
  });
  return f;
}

/// d f/d x from derivatives of segment forces by chords.
template <class ForEachBlock>
Eigen::MatrixXd nodal_stiffness(Eigen::Index coordinates, const ForEachBlock& for_each_block) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(coordinates, coordinates);
  for_each_block([&](std::size_t i, std::size_t j, const Eigen::Matrix3d& block) {
    for (const int row : {0, 1})
      for (const int column : {0, 1})
        K.block<3, 3>(3 * (static_cast<Eigen::Index>(i) + row),
                      3 * (static_cast<Eigen::Index>(j) + column)) += (row == column ? 1 : -1) * block;
  });
  return K;
}

inline Eigen::VectorXd sliding_force(const fem::SlidingCable& rope, const Eigen::VectorXd& x) {
  return nodal_forces(x.size(), [&](const auto& sink) { rope.segment_forces(chords_of(x), sink); });
}

/// A rope that winds through space with segments about a metre long.
inline Eigen::VectorXd winding_rope(Dice& dice, Eigen::Index nodes) {
  Eigen::VectorXd x(3 * nodes);
  core::Vector3 at(0, 0, 0);
  for (Eigen::Index k = 0; k < nodes; ++k) {
    x.segment<3>(3 * k) = at;
    at += core::Vector3(dice.uniform(0.5, 1.5), dice.uniform(-0.8, 0.8), dice.uniform(-0.8, 0.8));
  }
  return x;
}

inline Eigen::VectorXd reversed(const Eigen::VectorXd& stacked) {
  Eigen::VectorXd result(stacked.size());
  for (Eigen::Index i = 0; i < stacked.size(); i += 3)
    result.segment<3>(stacked.size() - 3 - i) = stacked.segment<3>(i);
  return result;
}

inline double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace talus::test
