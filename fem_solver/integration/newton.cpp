#include "fem_solver/integration/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus::fem {
namespace {

constexpr double steepest_uphill = 0.8;
constexpr int most_cuts = 40;

}  // namespace

Newton::Newton(const Model& model)
    : equations_(model),
      stiffness_(model, equations_),
      slides_(model, equations_),
      residual_(model.reference.size()),
      trial_(model.reference.size()) {}

NewtonReport Newton::solve(const NewtonSystem& system, const NewtonOptions& options,
                           std::vector<double>& displacement) {
  NewtonReport report;
  last_residual_ = std::numeric_limits<double>::infinity();
  slides_.start(displacement);
  evaluate(system, displacement);
  for (int iteration = 0; !measure(system, options, displacement, report); ++iteration) {
    if (iteration == options.most_iterations || !std::isfinite(report.residuals.back())) return report;
    if (slides_.exists()) solver_.forget_pattern();
    const SparseMatrix derivative = tangent(system, displacement);
    stiffest_ = equations_.count() > 0 ? derivative.diagonal().cwiseAbs().maxCoeff() : 0;
    const double shift = solver_.factorise_shifted(derivative);
    const Eigen::VectorXd step = solver_.solve(equations_.gather(residual_));
    if (shift > 0) ++report.shifted;
    if (search_along(system, step, displacement)) ++report.cut;
  }
  report.converged = true;
  return report;
}

std::vector<double> Newton::accelerations(Push push, std::vector<double>& displacement) {
  std::vector<double> found(push.force.size(), 0.0);
  if (!slides_.exists()) {
    for (Index k = 0; k < equations_.count(); ++k) {
      const auto i = static_cast<std::size_t>(equations_.direction(k));
      found[i] = push.force[i] / push.masses[i];
    }
    return found;
  }
  slides_.start(displacement);
  slides_.settle(displacement, push.force);
  solver_.forget_pattern();
  solver_.factorise(slides_.condense(stiffness_.assemble({displacement, {}}, 0, push.masses)));
  equations_.scatter_add(1, solver_.solve(equations_.gather(push.force)), found);
  slides_.lead(found);
  return found;
}

void Newton::evaluate(const NewtonSystem& system, const std::vector<double>& displacement) {
  ++evaluations_;
  system.residual(displacement, residual_);
  slides_.settle(displacement, residual_);
}

SparseMatrix Newton::tangent(const NewtonSystem& system, std::span<const double> displacement) {
  const SparseMatrix& free =
      stiffness_.assemble({displacement, system.memory}, system.stiffness_factor, system.diagonal);
  if (system.damping_factor != 0) stiffness_.add_damping(system.damping_state, system.damping_factor);
  return slides_.exists() ? slides_.condense_with_curvature(free) : free;
}

/// Notes the largest residual. @returns whether it is small enough
bool Newton::measure(const NewtonSystem& system, const NewtonOptions& options,
                     std::span<const double> displacement, NewtonReport& report) {
  double largest = 0;
  for (Index k = 0; k < equations_.count(); ++k) {
    const double size = std::abs(residual_[static_cast<std::size_t>(equations_.direction(k))]);
    if (size <= largest) continue;
    largest = std::isnan(size) ? std::numeric_limits<double>::infinity() : size;
    report.worst_direction = equations_.direction(k);
  }
  const double scale = system.force_scale();
  report.residuals.push_back(largest == 0 ? 0 : largest / scale);
  const bool falls = largest < 0.5 * last_residual_;
  last_residual_ = largest;
  return report.residuals.back() <= options.tolerance || (!falls && largest <= round_off(displacement));
}

/// Forces are differences of terms as large as stiffness times displacement.
double Newton::round_off(std::span<const double> displacement) const {
  constexpr double roundings = 8;
  double farthest = 0;
  for (const double u : displacement) farthest = std::max(farthest, std::abs(u));
  return roundings * std::numeric_limits<double>::epsilon() * stiffest_ * farthest;
}

/// Goes along `step` as far as the slope allows and leaves the residual there. @returns whether that was less
/// than the whole step
bool Newton::search_along(const NewtonSystem& system, const Eigen::VectorXd& step,
                          std::vector<double>& displacement) {
  const double slope_at_start = equations_.gather(residual_).dot(step);
  const auto places = slides_.places();
  double share = 1;
  for (int cut = 0;; ++cut) {
    trial_ = displacement;
    equations_.scatter_add(share, step, trial_);
    slides_.return_to(places);
    slides_.follow(trial_);
    evaluate(system, trial_);
    const double slope = equations_.gather(residual_).dot(step);
    if ((std::isfinite(slope) && slope >= -steepest_uphill * slope_at_start) || cut == most_cuts) {
      std::swap(displacement, trial_);
      return cut > 0;
    }
    const double secant = slope_at_start / (slope_at_start - slope);
    share *= std::isfinite(secant) ? std::clamp(secant, 0.1, 0.5) : 0.1;
  }
}

}  // namespace talus::fem
