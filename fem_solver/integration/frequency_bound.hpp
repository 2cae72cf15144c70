#pragma once

#include <vector>

#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// stiffness_bounds() of the directions that can move, 0 of those that supports hold.
std::vector<double> free_stiffness_bounds(const Model& model, const Configuration& at);

/// The largest ratio of such a bound to its mass (1/s^2), and the node that has it:
///
///     w^2 <= max over free directions i of  (sum over j of |K_ij|)/m_i
///
/// A bound that costs a few force evaluations, where the frequency itself costs a hundred. It holds with every slack
/// element taut. Exact for a chain and for a square net along its axes; up to twice w^2 where cables run across the
/// axes. Elements' numbers are summed by size before they meet, which can only raise the bound. Proven by: "bounds of
/// stiffness bound the highest frequency of a net at random states and give that of a chain", "... of a square net"
/// (step_limit_test.cpp).
struct FrequencyBound {
  double squared = 0;
  Index node = 0;
};
FrequencyBound frequency_bound(const Model& model, const Configuration& at);

}  // namespace talus::fem
