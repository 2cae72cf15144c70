#include "fem_solver/integration/mechanism.hpp"

#include <random>

#include "fem_solver/integration/linear_solver.hpp"

namespace talus::fem {
namespace {

constexpr double rounding =
    1e-12;  // of the largest diagonal entry: what sums of element blocks leave where nothing should be
constexpr int inverse_iterations = 20;

}  // namespace

SoftestMotion softest_motion(const SparseMatrix& tangent) {
  LinearSolver solver;
  if (solver.factorise_shifted(tangent) == 0) return {};
  Eigen::VectorXd motion(tangent.rows());
  std::mt19937_64 random(7);
  for (auto& value : motion) value = static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
  for (int k = 0; k < inverse_iterations; ++k) motion = solver.solve(motion).normalized();
  const double largest = tangent.diagonal().cwiseAbs().maxCoeff();
  const double quotient =
      motion.dot(tangent.selfadjointView<Eigen::Lower>() * motion) / std::max(largest, 1e-300);
  const auto kind = quotient < -rounding  ? SoftestMotion::Kind::unstable
                    : quotient < rounding ? SoftestMotion::Kind::mechanism
                                          : SoftestMotion::Kind::stiff;
  return {kind, quotient, motion};
}

}  // namespace talus::fem
