#pragma once

#include <span>

namespace talus::coupler {

/// What a window's nodal forces are: those at its start, which a leapfrog takes for its one step, or the mean
/// over several steps.
enum class ForceMeaning { at_start, mean };

/// Work of nodal forces on the motion of their nodes, window by window:
///
///     mean forces:        W = sum over windows, nodes of  f . (u_end - u_start)
///     forces at start:    W = sum over windows, nodes of  f . (u_end - u_start + v_start L) / 2
///
///     f   force         N, of the window on a node, as set on the surface
///     u   displacement  m, of the node at the window's two ends
///     v   velocity      m/s, half a step before the window's start
///     L   length        s, of the window
///     W   work          J, positive: the surface gains it
///
/// The second rule is the one under which a leapfrog keeps its energy: with u_end - u_start = L v_end the
/// kinetic energy m v_start . v_end / 2 changes by exactly this work. Tests: "work is force times path,
/// window by window", "the work of forces at a window's start is what the leapfrog's kinetic energy gains" in
/// run_test.cpp.
///
/// Only sums f . u are kept between a window's two ends, so nothing is copied. Their difference loses to
/// round-off what u is larger than the path of a window, 1e-12 of the work at a ten-thousandth.
class WorkMeter {
 public:
  struct Motion {
    std::span<const double> displacement, velocity;
  };
  struct Window {
    ForceMeaning meaning;
    double length = 0;  ///< s
  };

  /// At the window's start.
  /// @param force that the surface is going to bear
  WorkMeter(const Window& window, std::span<const double> force, const Motion& start) noexcept;
  /// The window's work (J), at its end.
  /// @pre `force` is that of its start
  double end(std::span<const double> force, std::span<const double> displacement) const noexcept;

 private:
  ForceMeaning meaning_;
  double pending_;  ///< the part of the window's sum that its start decides, J
};

/// Work of mean forces whose path is known at once, J.
double work_on_path(std::span<const double> mean_force, std::span<const double> start,
                    std::span<const double> end) noexcept;

}  // namespace talus::coupler
