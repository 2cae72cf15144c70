#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem_solver/boundary/boundary.hpp"

namespace talus::core {
class StateArchive;
}

namespace talus::dem {

/// What the boundary's nodes receive over a window, put together from the forces of single steps at the time
/// level at which the structure uses it.
///
///     mean = (rest + sum of w_k F_k h)/L        next rest = sum of (1 - w_k) F_k h
///
///     F_k    force       N, at t_k = t_n + k h, k = 0 ... N; its impulse belongs to [t_k - h/2, t_k + h/2], as
///                        the particles' own kicks do
///     L, h   length, step  s, of the window and of the N steps in it
///     s      shift       s, Command::force_shift; the mean is that over [t_n - s, t_n + L - s]
///     w_k    share       of a step's impulse that lies in this interval
///     rest               N s, impulses that the last window left for this one
///
/// So no impulse is lost or made. Where the interval ends after the middle of the last step, s < h/2, the force
/// at the window's end is part of the mean; the next window begins with that very force, so what it was taken
/// for is negative in the rest. With equal steps on both sides, s = h/2, nothing is left over, and with one step
/// a window the mean is the force at t_n, bit for bit: the leapfrog of the undivided system. Tests:
/// window_force.cpp, "windows of unequal steps are of second order" in unequal_steps_test.py.
class WindowForce {
 public:
  struct Window {
    double length = 0;       ///< s
    std::int64_t steps = 1;  ///< N
    double shift = 0;        ///< s
  };

  /// @param first node of the boundary that belongs to the interface, as all after it do
  WindowForce(Index first, std::size_t nodes) : first_(first), rest_(3 * nodes), next_rest_(3 * nodes) {}

  /// Starts a window with what the last one left. @param mean N, 3 a node: where the result goes
  void begin(const Window& window, std::span<double> mean);
  /// Whether the force at the window's end is part of the mean: add() then takes step number N, too.
  bool needs_end() const { return share_of(window_.steps) > 0; }
  /// Adds the boundary's present reactions as those of step k.
  /// @param velocity_of(node of the interface) its velocity at t_k (m/s), on which the forces do their work
  template <class VelocityOf>
  void add(const Boundary& boundary, std::int64_t k, const VelocityOf& velocity_of) {
    for (const Index node : boundary.loaded_nodes()) {
      if (node < first_) continue;
      const auto own = static_cast<std::size_t>(node - first_);
      const Triple<double> force = triple<double>(boundary.reaction()[node]);
      add(own, k, force);
      add_work(k, dot(force, velocity_of(own)));
    }
  }
  /// More work of step k's forces, as a mean power over the step (W).
  void add_work(std::int64_t k, double power);
  /// J; of the impulses that went into the mean.
  double work() const { return work_; }
  /// N s, 3 a node: what the last window left for this one.
  std::span<const double> rest() const { return rest_; }
  /// What the next window depends on.
  void archive(core::StateArchive& archive);

 private:
  double share_of(std::int64_t k) const;
  void add(std::size_t node, std::int64_t k, const Triple<double>& force);

  Index first_;
  Window window_;
  std::span<double> mean_;
  std::vector<double> rest_, next_rest_;
  std::vector<std::size_t> loaded_, next_loaded_;  ///< nodes whose rest may not be zero; some more than once
  double work_ = 0, next_work_ = 0;                ///< J; of this window, and of what it leaves
};

}  // namespace talus::dem
