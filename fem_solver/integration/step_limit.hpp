#pragma once

#include <span>
#include <string>
#include <vector>

#include "fem_solver/assembly/assembly.hpp"

namespace talus::fem {

/// A bound on the explicit step, with what sets it.
struct StepBound {
  std::string name;  ///< "penalty springs of edge_south alone"
  double seconds = 0;
  std::string reason;  ///< formula and values
};

/// Largest angular frequency of M^-1 K at a state, K the tangent with its geometric part and with slack
/// cables taken as taut, because they may snap taut in any step; supported
/// directions left out. Lanczos iteration on M^-1/2 K M^-1/2 (Parlett, The Symmetric Eigenvalue Problem,
/// chapter 13) from a fixed start vector: unlike plain power iteration it also separates the crowded upper
/// end of a net's spectrum within a few dozen products, and its residual bounds the error.
/// @returns 1/s; the estimate plus its residual bound. 0 where nothing is stiff.
double largest_frequency(Assembly& assembly, const Configuration& at);

/// dt = (2/w)(sqrt(1 + xi^2) - xi), xi = b w/2: stability of central differences with stiffness damping b
/// that lags half a step. From the characteristic polynomial at z = -1: w^2 dt^2 + 2 b w^2 dt = 4. Centred
/// mass damping drops out of it. Proven by: "a free oscillator is stable just below the limit and blows up
/// just above it" (step_limit_test.cpp).
/// @param frequency w, 1/s. @param damping the largest stiffness damping b (s). @returns s; infinity for w = 0
double stable_step(double frequency, double damping);

/// The bounds at a state, the tightest first: that of the whole structure; where it has several parts, those
/// of each part's stiffness alone on the structure's masses (bars, cables, sliding ropes, penalty springs,
/// ...); and that of the geometric stiffness of each prestressed part of bars or cables alone (at the
/// reference state). None but the first is enough, each is necessary: stiffness that is added only raises
/// frequencies (Courant's minimax principle).
std::vector<StepBound> step_bounds(Assembly& assembly, const Configuration& at);

}  // namespace talus::fem
