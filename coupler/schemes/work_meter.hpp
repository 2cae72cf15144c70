#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace talus::coupler {

/// What a window's nodal forces are: those at its start, which a leapfrog takes for its one step, or the mean
/// over several steps.
enum class ForceMeaning { at_start, mean };

/// Work of nodal forces on the motion of their nodes, window by window:
///
///     mean forces:        W = sum over windows, nodes of  f . (u_end - u_start)
///     forces at start:    W = sum over windows, nodes of  f . (u_end - u_start + v_start L) / 2
///
/// | symbol | variable     | meaning                                  | unit | shape    | sign |
/// |--------|--------------|------------------------------------------|------|----------|-------------------------|
/// | f      | force        | force of the window on a node            | N    | 3 a node | as set on the
/// surface   | | u      | displacement | of the node at the window's two ends     | m    | 3 a node | | | v
/// | velocity     | half a step before the window's start    | m/s  | 3 a node |                         | |
/// L      | length       | of the window                            | s    |          | | | W      | joules()
/// | work done on the surface since time 0    | J    |          | positive: surface gains |
///
/// The second rule is the one under which a leapfrog keeps its energy: with u_end - u_start = L v_end the
/// kinetic energy m v_start . v_end / 2 changes by exactly this work. Tests: "work is force times path,
/// window by window", "the work of forces at a window's start is what the leapfrog's kinetic energy gains" in
/// run_test.cpp.
class WorkMeter {
 public:
  struct Motion {
    std::span<const double> displacement, velocity;
  };
  explicit WorkMeter(ForceMeaning meaning) : meaning_(meaning) {}

  /// Remembers the loaded nodes and how they move; the unloaded ones do no work.
  void begin(std::span<const double> force, const Motion& start, double length);
  /// Adds the work since begin().
  void end(std::span<const double> displacement);
  /// Mean forces whose path is known at once.
  void add(std::span<const double> mean_force, std::span<const double> start, std::span<const double> end);
  double joules() const { return joules_; }

 private:
  struct LoadedValue {
    std::size_t index;
    double force, start, path_before;
  };
  ForceMeaning meaning_;
  std::vector<LoadedValue> loaded_;
  double joules_ = 0;
};

}  // namespace talus::coupler
