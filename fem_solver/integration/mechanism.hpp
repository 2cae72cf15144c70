#pragma once

#include <Eigen/Core>

#include "fem_solver/assembly/sparse_stiffness.hpp"

namespace talus::fem {

/// The softest motion of a structure in equilibrium.
struct SoftestMotion {
  enum class Kind { stiff, unstable, mechanism } kind = Kind::stiff;
  double relative_stiffness = 0;  ///< motion.K motion over the largest diagonal entry of K, |motion| = 1
  Eigen::VectorXd motion;         ///< one an equation; empty where everything is stiff
};

/// Looks for motions that meet no resistance (to rounding), or a negative one: inverse iteration with the
/// shifted tangent where the tangent itself is not positive definite.
SoftestMotion softest_motion(const SparseMatrix& tangent);

}  // namespace talus::fem
