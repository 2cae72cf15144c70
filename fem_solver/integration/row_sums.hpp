#pragma once

#include <span>
#include <vector>

#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// Sums of the sizes of the tangent's numbers in each row, 3 a node (N/m). Gershgorin's theorem on M^-1 K:
///
///     w^2 <= max over free directions i of  (sum over j of |K_ij|)/m_i
///
/// A bound that costs a few force evaluations, where the frequency itself costs a hundred. Exact for a chain
/// and for a square net along its axes; up to twice w^2 where cables run across the axes. Elements' numbers
/// are summed by size before they meet, which can only raise the bound. Proven by: "row sums bound the
/// highest frequency of a net at random states and give that of a chain" (step_limit_test.cpp).
std::vector<double> stiffness_row_sums(const Model& model, const Configuration& at);

/// The direction (3 node + 0, 1, 2) with the largest ratio of row sum to mass, and that ratio (1/s^2).
struct FrequencyBound {
  double squared = 0;
  std::size_t direction = 0;
};
FrequencyBound frequency_bound(const Model& model, const Configuration& at);

}  // namespace talus::fem
