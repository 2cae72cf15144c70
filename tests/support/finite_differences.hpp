#pragma once

#include <Eigen/Core>

/// Derivatives from values alone, to check the ones written down.
namespace talus::test {

/// Central differences of `value(x)` (a number or a vector) with the given step: one column an unknown. The
/// error is of the order step^2 times the third derivative plus round-off of the value divided by the step.
template <class Value>
Eigen::MatrixXd central_differences(const Value& value, const Eigen::VectorXd& at, double step) {
  Eigen::MatrixXd columns;
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    Eigen::VectorXd ahead = at, behind = at;
    ahead[k] += step;
    behind[k] -= step;
    const Eigen::VectorXd slope =
        (Eigen::VectorXd(value(ahead)) - Eigen::VectorXd(value(behind))) / (ahead[k] - behind[k]);
    if (k == 0) columns.resize(slope.size(), at.size());
    columns.col(k) = slope;
  }
  return columns;
}

/// A number as a vector of one component.
inline Eigen::VectorXd as_vector(double value) {
  return Eigen::VectorXd::Constant(1, value);
}

}  // namespace talus::test
