#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fem_solver/assembly/assembly.hpp"
#include "fem_solver/integration/external_force.hpp"
#include "fem_solver/integration/integrator.hpp"
#include "fem_solver/integration/newton.hpp"

namespace talus::fem {

/// What a static run asks of Newton.
struct StaticOptions {
  double end = 1;   ///< s; where gravity and loads without a table have grown to their full size
  double step = 1;  ///< s; of the load, halved where Newton fails
  NewtonOptions newton{};
  std::optional<double> tables_at = {};  ///< s; where tables are read; absent: at the time of the run
};

/// A moment of a static run, at equilibrium; its velocity stays zero.
struct StaticState : State {
  std::vector<double> reactions;  ///< N
  ExternalWorks works;            ///< J
  bool operator==(const StaticState&) const = default;
};

/// Equilibrium under loads that grow over the run's time: gravity, loads and prescribed motion without a
/// table of their own in proportion to time/end, the others as their tables say. A load step whose Newton
/// iteration fails is halved, down to 1/1024 of the step asked for. At the end of every advance the tangent
/// must carry every free direction; one that does not is an unsupported mechanism, and an error that names
/// the nodes that move.
class StaticSolver final : public Integrator {
 public:
  /// @pre model and assembly outlive the solver
  StaticSolver(const Model& model, Assembly& assembly, const StaticOptions& options)
      : StaticSolver(model, assembly, options, initial_state(model)) {}
  StaticSolver(const Model& model, Assembly& assembly, const StaticOptions& options, const State& start);

  void advance(double time, double length) override;
  const StaticState& state() const override { return state_; }
  std::span<const double> reactions() const override { return state_.reactions; }
  EnergyBalance balance() override;
  double interface_work() const override { return state_.works.interface; }
  double slide_gap(std::size_t slide) const override {
    return newton_.slides().gap(slide, state_.displacement);
  }
  std::int64_t force_evaluations() const override { return newton_.evaluations(); }
  void save() override { saved_ = state_; }
  void archive(core::StateArchive& archive) override;
  const char* method() const override { return "fem_solver static"; }
  void restore() override { state_ = saved_; }

  /// Newton's report of every load step of the last advance.
  const std::vector<NewtonReport>& reports() const { return reports_; }

 private:
  LoadTime load_time(double time) const;
  void start(double time);
  void note_reactions(std::span<const double> sum);
  bool equilibrate(double time);
  NewtonSystem system();
  void residual(std::span<const double> displacement, std::span<double> residual);
  void account(const StaticState& before, const LoadSpan& span);
  void check_for_mechanisms(double time);
  std::string nodes_that_move(const Eigen::VectorXd& motion) const;
  [[noreturn]] void report_failure(double time) const;

  const Model& model_;
  Assembly& assembly_;
  StaticOptions options_;
  std::vector<HeldDirection> held_;
  Newton newton_;
  StaticState state_;
  StaticState saved_;
  std::vector<double> external_;  ///< N; at the load being solved for
  double force_scale_ = 0;
  std::vector<NewtonReport> reports_;
  std::int64_t steps_ = 0;
};

}  // namespace talus::fem
