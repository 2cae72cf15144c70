#pragma once

#include <span>
#include <utility>
#include <vector>

#include "fem_solver/constraints/slide_projection.hpp"
#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// Sliders of one line held by multi-point constraints in an explicit run [P eq. 8-13]: carries the line's
/// nodes from the arrays of the run to SlideProjection and back.
class SlideRun {
 public:
  /// @pre model outlives the run; every slider, or the rope beside it, can move
  SlideRun(const Model& model, const SlideLine& line);

  struct Step {
    double length = 0;        ///< s
    double force_factor = 0;  ///< 1/s; of the step: force = mass * force_factor * change of velocity
  };
  /// Arrays of the run, 3 a node; reactions 3 a node of each support.
  struct Arrays {
    std::span<double> displacement, velocity, force, reactions;
  };
  /// After a free step: takes the sliders to their line, and books what that took as forces, so that energy
  /// and reactions see it.
  /// @return false where the constraints' impulses did not converge
  bool project(const Step& step, const Arrays& arrays) noexcept;
  /// Of the last step's forces on nodes that can move (W). @param velocity of the run, 3 a node
  double power(std::span<const double> velocity) const noexcept;
  /// Largest distance of a slider from its rope, at the start of the last step (m).
  double largest_violation() const noexcept { return projection_.largest_violation(); }

 private:
  void take(const Step& step, const Arrays& arrays) noexcept;
  void give(const Step& step, const Arrays& arrays) noexcept;
  void pull_supports(double force_factor, std::span<double> reactions) noexcept;

  /// A direction of one of nodes_ that a support holds.
  struct Held {
    std::size_t direction, reaction;
  };

  const Model& model_;
  std::size_t rope_nodes_;
  std::vector<Index> nodes_;  ///< of the rope, then the sliders
  std::vector<Held> held_;
  SlideProjection projection_;
  std::vector<double> positions_, velocities_, forces_, inverse_masses_, pulls_;  ///< 3 a node of nodes_
};

}  // namespace talus::fem
