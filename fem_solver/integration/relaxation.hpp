#pragma once

#include <cstdint>

#include "fem_solver/assembly/assembly.hpp"
#include "fem_solver/model/state.hpp"

namespace talus::fem {

struct RelaxationOptions {
  std::int64_t most_steps = 200000;
  double tolerance = 1e-6;  ///< largest force that is left over the largest force
};

/// The structure as it hangs before time 0, like equilibrium(), by dynamic relaxation with local damping (Cundall,
/// Distinct element models of rock and soil structure, 1987): it falls into place, each direction braked by a share of
/// the force that acts on it, until nothing pulls any more. That takes the same share of every motion in each of its
/// cycles, fast and slow ones alike, and vanishes where nothing moves. Finds the way where Newton's method has none to
/// go: parts without stiffness, nets and ropes that hang slack, ropes that turn taut.
///
///     v += (F - a |F| sign v)/m      u += v      m_i = max over directions of (sum over j of |K_ij|)
///
/// | symbol | meaning                                                                              | unit |
/// |--------|--------------------------------------------------------------------------------------|------|
/// | v, u   | way of a step, displacement                                                          | m    |
/// | F      | all forces at the state, with loads, gravity and supports as they are at time 0      | N    |
/// | a      | damping, 0.7                                                                         | 1    |
/// | m      | stands for mass, with a step of 1: the largest stiffness bound of the node (model.hpp) | N/m  |
///
/// No frequency exceeds 1 then, or sqrt(1 + a) where the brake adds to the force; steps are stable up to 2. What
/// elements remember follows from step to step, so ropes slip and brakes run as they do under a load that comes on
/// suddenly.
/// @throws core::NumericalError where the forces have not died down after most_steps, naming the node that is pulled
/// most
/// @param from its displacements and memory are where the structure falls from; the answer has the velocities of the
/// scene
State relax(const Model& model, Assembly& assembly, const RelaxationOptions& options, State from);

}  // namespace talus::fem
