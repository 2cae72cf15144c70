#pragma once

#include <span>
#include <utility>
#include <vector>

#include "fem_solver/constraints/slide_projection.hpp"
#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// What a run carries from step to step for its sliders.
struct SlideState {
  std::vector<double> segments;  ///< that each slider is on
  std::vector<double> moves;     ///< m; how the last step moved nodes back, 3 a node that takes part
  bool operator==(const SlideState&) const = default;
};

/// All sliders of a model that are held by multi-point constraints, in an explicit run [P eq. 8-13]: carries
/// their nodes from the arrays of the run to SlideProjection and back.
class SlideRun {
 public:
  /// @pre model outlives the run; every slider, or the rope beside it, can move
  explicit SlideRun(const Model& model);

  bool exists() const noexcept { return !slides_.empty(); }
  /// At the start of a run. @param displacement 3 a node of the model (m)
  SlideState find(std::span<const double> displacement);

  struct Step {
    double length = 0;  ///< s
    double kick = 0;    ///< s; over which forces change velocities
  };
  /// Arrays of the run, 3 a node; reactions 3 a node of each support.
  struct Arrays {
    std::span<double> displacement, velocity, force, reactions;
    SlideState& slides;
  };
  /// After a free step: takes what leads sliders off their ropes, books it as forces, so that energy and reactions
  /// see it, and moves what the step has left of a gap back without speed.
  /// @return false where one of the two did not converge
  bool hold(const Step& step, const Arrays& arrays) noexcept;
  /// Of the last step's constraint forces (W). @param velocity of the run, 3 a node
  double power(std::span<const double> velocity) const noexcept;
  /// Work of forces on how the last step moved nodes back (J). @param force of the run, 3 a node (N)
  double work_of_moves(const SlideState& slides, std::span<const double> force) const noexcept;
  /// From places after the last step to those that its velocities led to. @param displacement 3 a node (m)
  void undo_moves(const SlideState& slides, std::span<double> displacement) const noexcept;

  /// How far a slider of slide number `slide` was off its rope before the last step moved it back (m).
  double largest_violation(std::size_t slide) const noexcept;

 private:
  void take(std::span<const double> from, std::span<double> to) const noexcept;
  bool stop(const Step& step, const Arrays& arrays) noexcept;
  bool put_back(const Arrays& arrays) noexcept;
  void pull_supports(double kick, std::span<double> reactions) noexcept;
  /// Of a force over mass and change of velocity (1/s); mass damping takes its share.
  double force_factor(double kick, std::size_t node) const noexcept;
  void set_positions(std::span<const double> displacement) noexcept;

  /// A direction of one of nodes_ that a support holds.
  struct Held {
    std::size_t direction, reaction;
  };

  const Model& model_;
  std::vector<std::size_t> slides_;  ///< number of each sliders' slide
  std::vector<Index> nodes_;         ///< that take part, ascending
  std::vector<Held> held_;
  SlideProjection projection_;
  std::vector<double> positions_, velocities_, forces_, inverse_masses_, pulls_;  ///< 3 a node of nodes_
};

}  // namespace talus::fem
