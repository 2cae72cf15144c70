#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "fem_solver/assembly/assembly.hpp"
#include "fem_solver/constraints/held_directions.hpp"
#include "fem_solver/integration/integrator.hpp"
#include "fem_solver/integration/slide_run.hpp"
#include "fem_solver/integration/step_watch.hpp"

namespace talus::fem {

/// Whether a structure has moved since the start: before its first step nobody knows.
enum class Rest : std::int64_t { to_be_seen, rests, moves };

/// A moment of the run.
struct ExplicitState : State {
  std::vector<double>
      force;  ///< N; sum of all forces at the time of the last evaluation, zero where supported
  std::vector<double>
      reactions;  ///< N; forces of the supports at that time, 3 a node of each support in turn
  std::int64_t steps = 0;
  Rest rest = Rest::to_be_seen;
  double previous_step = 0;  ///< s; 0 before the first step
  double kick = 0;           ///< s; the last step's
  double damped = 0;         ///< J; by mass damping, the half step behind the last evaluation included
  SlideState slides;
  /// Work of a force at an evaluation belongs half to the step before it and half to the step after it.
  struct Work {
    double done = 0;     ///< J; up to the last evaluation
    double pending = 0;  ///< J; of the half step behind it
    bool operator==(const Work&) const = default;
  };
  std::array<Work, 6>
      works;  ///< by loads, supports, the interface, stiffness damping, changing gravity, slides
  bool operator==(const ExplicitState&) const = default;
};

/// Central differences with lumped masses, in leapfrog form (Belytschko, Liu, Moran, Nonlinear Finite
/// Elements, section 6.2):
///
///     v(n+1/2) = ((1 - a k/2) v(n-1/2) + k F(n)/m)/(1 + a k/2)      u(n+1) = u(n) + dt v(n+1/2)
///     k = (dt_before + dt)/2
///
/// | symbol | variable  | meaning                                                                  | unit   |
/// |--------|-----------|--------------------------------------------------------------------------|--------|
/// | v      | velocity  | nodal velocity, half a step before the displacement's time               | m/s    |
/// | F      | force     | external forces minus dU/du minus b D v(n-1/2), D: damping_product()     | N      |
/// | m      | node mass |                                                                          | kg     |
/// | a, b   |           | damping rate of the node, stiffness damping of the part                  | 1/s, s |
/// | k      | kick      | from the middle of the last step to the middle of this one; before the   | s      |
/// |        |           | first step dt_before = 0, which is the half-step start                   |        |
///
/// Mass damping is centred and costs no stability; stiffness damping lags by half a step and lowers the
/// limit, see step_limit.hpp. Invariant of an undamped run: 1/2 v(n-1/2).m v(n+1/2) + U(u(n)) - work, exactly
/// for linear elasticity and free of drift for all. Proven by: "a free oscillator keeps the leapfrog's own
/// energy to round-off" (explicit_test.cpp).
class ExplicitSolver final : public Integrator {
 public:
  /// @pre every node has mass or is fully supported; model and assembly outlive the solver
  /// @param step the longest one advance() takes (s)
  ExplicitSolver(const Model& model, Assembly& assembly, double step)
      : ExplicitSolver(model, assembly, step, initial_state(model)) {}
  ExplicitSolver(const Model& model, Assembly& assembly, double step, const State& start);

  void advance(double time, double length) override;
  void prepare() override;
  std::span<const double> reactions() const override { return state_.reactions; }
  std::span<const double> free_velocity(double time, double step) override;
  /// The balance at the time of the last force evaluation, one step before the present; before the first
  /// step, at time 0.
  EnergyBalance balance() override;
  double interface_work() const override {
    return state_.works[by_interface].done + state_.works[by_interface].pending;
  }
  double slide_gap(std::size_t slide) const override { return slides_.largest_violation(slide); }
  std::int64_t force_evaluations() const override { return force_evaluations_; }
  void save() override { saved_ = state_; }
  void archive(core::StateArchive& archive) override;
  const char* method() const override { return "fem_solver explicit"; }
  void restore() override {
    state_ = saved_;
    prepared_ = false;
  }

  /// One step from `time` to `time + step` (s).
  /// @throws NumericalError if a velocity stops being finite
  void step(double time, double step);

  /// From here on the run ends with a NumericalError where the structure stiffens beyond its step.
  void watch_step() { watch_.emplace(assembly_); }

  /// To change it.
  ExplicitState& state() {
    prepared_ = false;
    return state_;
  }
  const ExplicitState& state() const override { return state_; }

 private:
  /// A structure whose forces cancel to round-off, and to which nothing happens, rests until the interface
  /// touches it: its steps cost nothing. Round-off alone would move it by some 1e-15 m.
  bool stays_at_rest(double time, double step) noexcept;
  bool starts_in_balance(double time, double step) noexcept;
  /// All forces but the supports'; on the interface those that are set.
  void evaluate_forces(double time) noexcept;
  /// Forces of the structure itself and of its loads.
  void evaluate_own_forces(double time, std::span<double> force) noexcept;
  void subtract_stiffness_damping(std::span<double> force) noexcept;
  /// Replaces the force on supported directions by the one that leads to their prescribed position at the
  /// step's end.
  void impose_supports(double time, double step) noexcept;
  /// A step of the leapfrog in numbers.
  struct Leap {
    double kick = 0;         ///< s
    double half_before = 0;  ///< s
    double step = 0;         ///< s
  };
  /// Half of what mass damping takes of a velocity in a kick.
  double half_damping_of(std::size_t node) const noexcept {
    return damping_rate_.empty() ? 0 : 0.5 * damping_rate_[3 * node] * state_.kick;
  }
  template <bool damped>
  double advance_values(const Leap& leap, core::Block values) noexcept;
  /// Sum of velocities squared, or what mass damping dissipates (J): finite as long as every velocity is.
  template <class MassDamping>
  double advance_nodes(double step) noexcept;
  /// With the terms that the scene names.
  double advance_free(double step) noexcept;
  /// Energy that moving sliders back has brought in: elements and weight work on the way, nothing else does.
  void book_moves();
  /// What mass damping has taken where sliders were led: the velocities that count are those after it.
  void damp_sliding_nodes(double step) noexcept;
  /// Takes sliders back to their ropes after a free step.
  void hold_slides(double time, double step);
  enum WorkLine : std::size_t {
    by_loads,
    by_supports,
    by_interface,
    by_stiffness_damping,
    by_gravity,
    by_slides
  };
  using Powers = std::array<double, by_slides>;  ///< of what is known before the step
  Powers powers(double time) const noexcept;
  double power_of_supports() const noexcept;
  void arrive(double time) noexcept;
  void leave(double time, double step) noexcept;
  EnergyBalance balance_at_evaluation() const;
  std::vector<double> displacement_at_evaluation() const;
  void add_kinetic(EnergyBalance& balance) const;
  [[noreturn]] void report_blow_up(double time) const;

  const Model& model_;
  Assembly& assembly_;
  double longest_step_;
  ExplicitState state_;
  ExplicitState saved_;
  std::optional<StepWatch> watch_;
  /// Held directions that stay where they are, as the step's loop reads them.
  struct Fixed {
    std::uint32_t direction, reaction;
  };
  std::vector<Fixed> fixed_;
  std::vector<HeldDirection> led_;       ///< the others
  SlideRun slides_;                      ///< of the model's constrained slides
  std::vector<double> velocity_before_;  ///< m/s; of the step in progress, where there are slides
  std::vector<double> inverse_mass_;     ///< 1/kg; of each direction, 0 for a node without mass
  std::vector<double> mass_;             ///< kg; of each direction, only where the scene names mass damping
  std::vector<double> damping_rate_;     ///< 1/s; of each direction, likewise
  std::vector<double> damping_force_;    ///< N; only where the scene names stiffness damping
  std::vector<double> free_velocity_;    ///< m/s; only where somebody asks for it
  std::vector<double> element_force_;    ///< N; of the elements at the present state, where prepared
  bool prepared_ = false;
  std::int64_t force_evaluations_ = 0;
  core::OrderedSum<> sum_;
};

}  // namespace talus::fem
