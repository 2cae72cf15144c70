#pragma once

#include <vector>

#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// The node with the largest ratio of stiffness bound (model.hpp) to mass among those that can move, and that ratio
/// (1/s^2). By Gershgorin's theorem on M^-1 K, by blocks of 3 x 3:
///
///     w^2 <= max over nodes i of  (sum over j of ||K_ij||)/m_i
///
/// A bound that costs a few force evaluations, where the frequency itself costs a hundred. It holds with every slack
/// element taut. Exact for a chain and for a square net along its axes; up to twice w^2 where cables run across the
/// axes. Proven by: "bounds of stiffness bound the highest frequency of a net at random states and give that of a
/// chain" (step_limit_test.cpp).
struct FrequencyBound {
  double squared = 0;
  Index node = 0;
};
FrequencyBound frequency_bound(const Model& model, const Configuration& at);

}  // namespace talus::fem
