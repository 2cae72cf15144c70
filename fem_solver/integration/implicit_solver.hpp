#pragma once

#include <span>
#include <vector>

#include "fem_solver/assembly/assembly.hpp"
#include "fem_solver/integration/external_force.hpp"
#include "fem_solver/integration/integrator.hpp"
#include "fem_solver/integration/newton.hpp"

namespace talus::fem {

struct ImplicitOptions {
  double step = 0;  ///< s; the longest one advance() takes, halved where Newton fails
  double spectral_radius =
      1;  ///< at infinite frequency: 1 keeps every motion, 0 removes what a step cannot resolve
  NewtonOptions newton{};
};

/// A moment of an implicit run, at the end of a step.
struct ImplicitState : State {
  std::vector<double> acceleration;     ///< m/s^2
  std::vector<double> force;            ///< N; external minus internal at the present time
  std::vector<double> interface_force;  ///< N; the part of it that came through the interface
  std::vector<double> reactions;        ///< N; 3 a supported node
  ExternalWorks works{};                ///< J
  double damped = 0;                    ///< J
  double created = 0;         ///< J; energy that came from nowhere so far, by the balance; negative: lost
  double largest_energy = 0;  ///< J; on the move or supplied, so far
  std::int64_t steps = 0;
  bool operator==(const ImplicitState&) const = default;
};

/// Generalised-alpha method with Newton's iteration. Source: Chung and Hulbert, J. Appl. Mech. 60 (1993), eq.
/// 11-19 and 25, with the forces of both ends of a step combined.
///
///     M ((1 - am) a1 + am a0) + C ((1 - af) v1 + af v0) = (1 - af) F(u1) + af F(u0)
///     u1 = u0 + dt v0 + dt^2 ((1/2 - b) a0 + b a1)      v1 = v0 + dt ((1 - g) a0 + g a1)
///     am = (2 r - 1)/(r + 1)   af = r/(r + 1)   g = 1/2 - am + af   b = (1 - am + af)^2/4
///
/// | symbol  | variable        | meaning                                                            | unit      |
/// |---------|-----------------|--------------------------------------------------------------------|-----------|
/// | r       | spectral_radius | of the step's amplification at infinite frequency, 0 to 1          | 1         |
/// | u, v, a |                 | displacement and its rates; 0 at the step's start, 1 at its end    | m, ...    |
/// | M, C    |                 | lumped mass; damping a M + b D with D (damping_product()) inside the step | kg, N s/m |
/// | F       |                 | external minus internal forces                                     | N         |
///
/// The forces of the interface are a load that is constant over a window and jumps at its ends. So F(u0) of a
/// window's first step is taken with the window's own forces, and a0 with the acceleration they give: a load
/// acts whole from the first step on, as in
///
///     M (...) + C (...) = (1 - af) F_own(u1) + af F_own(u0) + f      f  interface force of the window, N
///
/// and does exactly the work f . (u1 - u0). Tests: "a load that sets in acts whole in its first step", "the work
/// of interface forces is what the structure gains" (implicit_test.cpp).
///
/// Nothing in the method keeps the energy of a structure that is not linear: a sheet that wrinkles and snaps taut
/// within a step may gain some in every step, at r near 1 without bound (Kuhl and Crisfield, Int. J. Numer. Meth.
/// Engng 45 (1999)). So a step that creates energy, once more than a hundredth of what is on the move has come
/// from nowhere, is halved as one whose iteration fails is; short steps follow the snapping, and keep it.
///
/// Second order, unconditionally stable for linear structures. At r = 1 it is the trapezoidal rule.
/// Proven by: "the trapezoidal rule turns a linear oscillator by its own angle" (implicit_test.cpp).
class ImplicitSolver final : public Integrator {
 public:
  /// @pre model and assembly outlive the solver
  ImplicitSolver(const Model& model, Assembly& assembly, const ImplicitOptions& options)
      : ImplicitSolver(model, assembly, options, initial_state(model)) {}
  ImplicitSolver(const Model& model, Assembly& assembly, const ImplicitOptions& options, const State& start);

  void advance(double time, double length) override;
  const ImplicitState& state() const override { return state_; }
  std::span<const double> reactions() const override { return state_.reactions; }
  /// The balance at the present time; works by the trapezoidal rule over each step.
  EnergyBalance balance() override;
  double interface_work() const override { return state_.works.interface; }
  double slide_gap(std::size_t slide) const override {
    return newton_.slides().gap(slide, state_.displacement);
  }
  std::int64_t force_evaluations() const override { return newton_.evaluations(); }
  void save() override { saved_ = state_; }
  void archive(core::StateArchive& archive) override;
  const char* method() const override { return "fem_solver implicit"; }
  void restore() override { state_ = saved_; }

  ImplicitState& state() { return state_; }
  const std::vector<NewtonReport>& reports() const { return reports_; }

 private:
  struct Step {
    double time, length;
  };
  void start(double time);
  void lead_supports_off(double time);
  /// Lets the interface's forces jump to those of this window.
  void take_interface_force();
  std::vector<double> masses_of_directions() const;
  bool take(const Step& step);
  void predict(const Step& step);
  void update_rates(double length, std::span<const double> displacement);
  void residual(const Step& step, std::span<const double> displacement, std::span<double> residual);
  NewtonSystem system(const Step& step);
  /// 3 a node (m, m/s)
  struct Motion {
    std::span<const double> displacement, velocity;
  };
  /// out += factor * C(displacement) velocity
  void add_damping(double factor, const Motion& motion, std::span<double> out);
  void total_force(double time, std::span<const double> displacement, std::span<double> force);
  void account(const Step& step);
  /// Books what the step has created. @return whether it may stand
  bool keeps_energy();
  double energy() const;   ///< J
  double kinetic() const;  ///< J
  [[noreturn]] void report_failure(const Step& step) const;

  const Model& model_;
  Assembly& assembly_;
  ImplicitOptions options_;
  double alpha_m_, alpha_f_, gamma_, beta_;
  std::vector<HeldDirection> held_;
  Newton newton_;
  ImplicitState state_;
  ImplicitState saved_;
  ImplicitState before_;                          ///< the start of the step in progress
  std::vector<double> mean_, mean_displacement_;  ///< velocity and displacement inside a step
  std::vector<double> product_;                   ///< N; what resists strain rates
  double force_scale_ = 0;
  std::vector<NewtonReport> reports_;
  double extent_ = 0;            ///< m; of the structure
  double energy_before_ = 0;     ///< J; at the start of the step in progress
  bool created_energy_ = false;  ///< why the last step was taken back
};

}  // namespace talus::fem
