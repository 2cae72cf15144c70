#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fem_solver/integration/force_record.hpp"
#include "fem_solver/integration/interface_force.hpp"
#include "fem_solver/model/state.hpp"

namespace talus::fem {

/// Energies at one time level and works up to it (J).
struct EnergyBalance {
  double kinetic = 0;
  std::vector<double> elastic;     ///< of each part
  std::vector<double> dissipated;  ///< of each part: rope friction, brakes, plastic work
  double gravity = 0;              ///< potential, zero at the reference state
  double bulk_damping = 0;         ///< dissipated
  double loads = 0;                ///< supplied by nodal loads
  double supports = 0;             ///< supplied by prescribed motion
  double interface = 0;            ///< supplied through the interface
  double slides = 0;               ///< taken by the constraints of sliders, whose error it is
};

/// A way of going through time, as a program sees it: called once a window, never inside a step.
class Integrator {
 public:
  /// @param start where its state has a record, the largest forces are noted there at every step
  Integrator(const Model& model, const State& start) {
    if (!start.record.empty()) record_.emplace(model);
  }
  virtual ~Integrator() = default;

  /// From `time` to `time + length` (s), in as many steps as it takes.
  /// @throws core::NumericalError where the computation breaks down
  virtual void advance(double time, double length) = 0;
  /// Computes what the next step needs and nobody can change any more, while others are still at work. A step
  /// has the same bits with and without.
  virtual void prepare() {}

  virtual const State& state() const = 0;
  std::span<const double> displacement() const { return state().displacement; }
  std::span<const double> velocity() const { return state().velocity; }
  /// The velocity (m/s, 3 a node) that a step of `step` (s) from the present `time` (s) would lead to if no
  /// interface force acted in it, before the constraints of sliders; empty where the integrator cannot say
  /// it.
  virtual std::span<const double> free_velocity([[maybe_unused]] double time, [[maybe_unused]] double step) {
    return {};
  }
  /// Forces of the supports on the structure (N), 3 for every node of every support in turn.
  virtual std::span<const double> reactions() const = 0;
  virtual EnergyBalance balance() = 0;
  /// Supplied through the interface so far, by this integrator's own ledger (J).
  virtual double interface_work() const = 0;
  /// Of all elements, since the start: the cost that does not depend on the machine. What was taken back
  /// counts.
  virtual std::int64_t force_evaluations() const = 0;
  /// Largest distance of a slider of constrained slide number `slide` from its rope (m).
  virtual double slide_gap([[maybe_unused]] std::size_t slide) const { return 0; }

  virtual void save() = 0;     ///< remembers the present state
  virtual void restore() = 0;  ///< goes back to the state remembered last

  /// The whole present state, to write it to a file or to take it from one.
  virtual void archive(core::StateArchive& archive) = 0;
  /// Whose state that is: states of different methods do not fit each other.
  virtual const char* method() const = 0;

  InterfaceForce& interface() { return interface_; }
  double last_output_time = -1;  ///< s; told by errors; negative: none

 protected:
  InterfaceForce interface_;
  std::optional<ForceRecord> record_;
};

}  // namespace talus::fem
