#pragma once

#include <span>
#include <vector>

#include "dem_solver/boundary/boundary.hpp"

namespace talus::dem {

/// Boundary nodes that, besides the motion they are given, answer to their contact forces with their own
/// mass:
///
///     w_n+1 = w_n + h r_n/m        d_n+1 = d_n + h w_n+1        from w = p/m, d = 0 at a window's start
///
///     d, w   displacement, velocity   m, m/s   of a node, added to what it is given
///     r      reaction                 N        of its contacts at the step's start
///     p      impulse                  N s      of forces before the window that the structure has not had yet
///                                              (negative: that it had too early), WindowForce::rest()
///     m      mass                     kg       behind the node; infinite or 0: it moves as given
///     h      step                     s        below the limits of a contact on m, docs/step_limits.md
///
/// A rock's contact with a node a thousand times lighter cannot be computed against a boundary of prescribed
/// motion over more than a few microseconds: the dashpot would push as if nothing gave way. Test: "a light
/// boundary gives way as a free mass does" in light_nodes.cpp.
class LightNodes {
 public:
  /// @param masses kg; of the boundary's nodes from `first` on
  LightNodes(std::span<const double> masses, Index first);

  /// @param impulse N s, 3 a node
  void begin_window(std::span<const double> impulse) noexcept;
  /// Adds the answer so far to the boundary's motion, which was given anew for this step.
  void displace(Boundary& boundary) const noexcept;
  /// The answer to the reactions of the step just done. @param step s
  void answer(const Boundary& boundary, double step) noexcept;

  /// m; of all nodes from `first` on, 3 values each.
  std::span<const double> displacement() const noexcept { return displacement_; }
  /// m/s; of a node from `first` on, half a step before the reactions and, with them, half a step after.
  Triple<double> velocity(std::size_t node) const noexcept {
    return {velocity_[3 * node], velocity_[3 * node + 1], velocity_[3 * node + 2]};
  }
  double inverse_mass(std::size_t node) const noexcept { return inverse_mass_[node]; }

 private:
  Index first_;
  std::vector<double> inverse_mass_;             ///< 1/kg
  std::vector<double> displacement_, velocity_;  ///< m, m/s
};

}  // namespace talus::dem
