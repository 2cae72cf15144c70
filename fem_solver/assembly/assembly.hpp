#pragma once

#include <span>
#include <vector>

#include "core/program/stage_clock.hpp"
#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// Stages of a step whose time is told apart where the scene asks for it, behind one for the elements of each
/// part.
enum class StepStage : std::size_t { sum_at_nodes, other_forces, motion, slides, energy, everything_else };
/// Their names, those of the parts first.
std::vector<std::string> stages_of(const Model& model);

/// From element forces to node forces without races: every element writes its own slots, then every node sums
/// the slots that belong to it in a fixed order. So the result has the same bits for any number of threads.
class Assembly {
 public:
  /// @pre model outlives the assembly and its parts are not changed
  explicit Assembly(const Model& model);

  /// force = -dU/du at every node. All spans 3 a node; force in N.
  void internal_force(const Configuration& at, std::span<double> force) noexcept;
  /// What elements remember if the state of the last internal_force() is accepted.
  std::span<const double> next_memory() const noexcept { return next_memory_; }
  /// product = (d2U/du2) direction at every node.
  void stiffness_product(const Configuration& at, std::span<const double> direction,
                         std::span<double> product) noexcept;
  /// What resists strain rates: the stiffness damping of each part times its damping_product(), at every node (N).
  /// @pre a part has stiffness damping
  void damping_force(const Configuration& at, std::span<const double> velocity,
                     std::span<double> force) noexcept;
  /// The same with everything taut that can be, for step limits.
  void stiffest_product(const Configuration& at, std::span<const double> direction,
                        std::span<double> product) noexcept;

  /// The largest component of any element's force in the last internal_force (N).
  double largest_element_force() const noexcept;

  const Model& model() const { return model_; }

  /// From here on the time of internal_force() is told by parts to this clock, whose stages are those of
  /// stages_of(). @pre it outlives the assembly
  void measure_stages(core::StageClock& clock) noexcept { clock_ = &clock; }
  /// A step begins; the time up to here belongs to a stage. Nothing happens where no clock runs.
  void start_step() const noexcept { core::start(clock_); }
  void lap(StepStage stage) const noexcept {
    core::lap(clock_, model_.parts.size() + static_cast<std::size_t>(stage));
  }

 private:
  template <class Compute>
  void compute_slots(const Configuration& at, const Compute& compute) noexcept;
  std::span<double> slots_of(std::size_t part) noexcept;
  void gather(double factor, std::span<double> sums) const noexcept;

  const Model& model_;
  std::vector<std::size_t> slot_begin_;    ///< of each part, and the end
  std::vector<double> slots_;              ///< 3 a slot
  std::vector<std::size_t> memory_begin_;  ///< of each part, and the end
  std::vector<double> next_memory_;
  std::vector<Index> incidence_begin_;  ///< of each node's slots, then of those it feels negated; and the end
  std::vector<Index> incidence_;        ///< first value of the slot
  core::StageClock* clock_ = nullptr;   ///< nullptr: nobody asks for times
};

}  // namespace talus::fem
