#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fem_solver/assembly/sparse_stiffness.hpp"
#include "fem_solver/integration/linear_solver.hpp"
#include "fem_solver/integration/slide_elimination.hpp"

namespace talus::fem {

/// The equations of one load or time step: residual(u) = 0 in the free directions, with the derivative
/// -(stiffness_factor d2U/du2 + damping_factor D + diagonal).
struct NewtonSystem {
  std::function<void(std::span<const double> displacement, std::span<double> residual)>
      residual;                         ///< N, 3 a node
  std::function<double()> force_scale;  ///< N; size of the forces that balance in the residual computed last
  std::span<const double> memory = {};  ///< of the elements, at the step's start
  double stiffness_factor = 1;
  std::vector<double> diagonal;  ///< N/m, 3 a node
  double damping_factor = 0;     ///< 1/s; of what resists strain rates, at `damping_state`
  Configuration damping_state{std::span<const double>{}, std::span<const double>{}};
};

struct NewtonOptions {
  /// Largest residual over force_scale. Where all forces vanish (a prestressed bar let go)
  /// a residual that falls no more, and is round-off of the stiffness times the displacements, is
  /// enough.
  double tolerance = 1e-10;
  int most_iterations = 60;
};

/// Of the step asked for: how far one whose iteration fails is halved.
inline constexpr double smallest_share_of_step = 1.0 / 1024;

struct NewtonReport {
  bool converged = false;
  std::vector<double> residuals;  ///< largest, over force_scale; the first before any iteration
  int shifted = 0;                ///< iterations whose tangent was not positive definite and was shifted
  int cut = 0;                    ///< iterations whose step the line search shortened
  Index worst_direction = 0;      ///< 3 node + 0, 1, 2
};

/// Newton's method with a line search. Where the tangent is not positive definite (slack nets, snapping bars)
/// it is shifted until it is, so that every step goes downhill in energy; the report counts them. The line
/// search asks for no more than that the slope along the step has not turned steeply uphill, |g(s)| < 0.8
/// |g(0)|, and so needs no differences of energies. Sliders held by constraints stay on their ropes throughout.
class Newton {
 public:
  explicit Newton(const Model& model);

  /// Changes the free directions of `displacement` until the residual vanishes; supported ones stay as given.
  NewtonReport solve(const NewtonSystem& system, const NewtonOptions& options,
                     std::vector<double>& displacement);

  /// What masses do under forces, with sliders on their ropes: m/s^2, 3 a node, 0 where supported.
  struct Push {
    std::span<const double> masses;  ///< kg, 3 a node
    std::vector<double> force;       ///< N, 3 a node
  };
  std::vector<double> accelerations(Push push, std::vector<double>& displacement);

  const Equations& equations() const { return equations_; }
  const SlideElimination& slides() const { return slides_; }
  std::int64_t evaluations() const { return evaluations_; }  ///< of the residual, since the start
  /// -(derivative of the residual) at the state solve() has left, lower half.
  SparseMatrix tangent(const NewtonSystem& system, std::span<const double> displacement);

 private:
  void evaluate(const NewtonSystem& system, const std::vector<double>& displacement);
  bool measure(const NewtonSystem& system, const NewtonOptions& options, std::span<const double> displacement,
               NewtonReport& report);
  bool search_along(const NewtonSystem& system, const Eigen::VectorXd& step,
                    std::vector<double>& displacement);

  Equations equations_;
  SparseStiffness stiffness_;
  SlideElimination slides_;
  LinearSolver solver_;
  double round_off(std::span<const double> displacement) const;

  std::vector<double> residual_, trial_;
  double last_residual_ = 0;  ///< N
  double stiffest_ = 0;       ///< N/m; the largest diagonal entry of the last tangent
  std::int64_t evaluations_ = 0;
};

}  // namespace talus::fem
