#include "fem_solver/constraints/slide_projection.hpp"

#include <algorithm>
#include <cmath>

#include "fem_solver/constraints/nearest_segment.hpp"

namespace talus::fem {
namespace {

/// Of the velocities across the ropes, relative to those of sliders and rope.
constexpr double closeness = 1e-13;

/// The 3-vector of a node in an array of many, to read or to write.
template <class Array>
auto at(Array&& values, std::size_t node) noexcept {
  return Eigen::Map<std::conditional_t<std::is_const_v<std::remove_reference_t<decltype(values[0])>>,
                                       const Vector3, Vector3>>(&values[3 * node]);
}

double dot(std::span<const double> a, std::span<const double> b) noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

SlideProjection::SlideProjection(const Sizes& sizes)
    : sizes_(sizes),
      contacts_(sizes.sliders),
      impulse_(3 * sizes.sliders),
      residual_(3 * sizes.sliders),
      direction_(3 * sizes.sliders),
      product_(3 * sizes.sliders),
      change_(3 * (sizes.rope_nodes + sizes.sliders)) {}

bool SlideProjection::project(const Step& step, std::span<double> velocities) noexcept {
  find_contacts(step, velocities);
  const double enough = start_residuals(step, velocities);
  const bool converged = solve_impulses(step, enough);
  spread(impulse_, step);
  for (std::size_t i = 0; i < change_.size(); ++i) velocities[i] += change_[i];
  return converged;
}

/// residual = -P (dg/dt + g/dt) without impulses. @returns the square at which it is round-off: of
/// the velocities that its differences are taken of, however small these are themselves
double SlideProjection::start_residuals(const Step& step, std::span<const double> velocities) noexcept {
  std::ranges::fill(impulse_, 0.0);
  double speeds = 0;
  for (std::size_t k = 0; k < sizes_.sliders; ++k) {
    const Vector3 back = relative(k, step.positions) / step.length;
    at(residual_, k) = across(k, -relative(k, velocities) - back);
    speeds += at(velocities, sizes_.rope_nodes + k).squaredNorm() +
              at(velocities, contacts_[k].segment).squaredNorm() +
              at(velocities, contacts_[k].segment + 1).squaredNorm() + back.squaredNorm();
  }
  return closeness * closeness * speeds;
}

// The system is singular along the ropes. Residuals are therefore turned across them anew each time: what
// round-off leaves along a rope would be divided by round-off and come back as an impulse of any size.
bool SlideProjection::solve_impulses(const Step& step, double enough) noexcept {
  const std::size_t most_steps = 20 * sizes_.sliders + 20;
  double old_slope = 0;
  for (std::size_t count = 0; dot(residual_, residual_) > enough; ++count) {
    const double slope = weighted_residual(step);
    for (std::size_t k = 0; k < sizes_.sliders; ++k) {
      at(direction_, k) *= count == 0 ? 0 : slope / old_slope;
      at(direction_, k) += preconditioner(k, step) * at(residual_, k);
    }
    spread(direction_, step);
    for (std::size_t k = 0; k < sizes_.sliders; ++k) at(product_, k) = across(k, relative(k, change_));
    const double curvature = dot(direction_, product_);
    if (count == most_steps || !(curvature > 0)) return false;
    for (std::size_t i = 0; i < impulse_.size(); ++i) {
      impulse_[i] += slope / curvature * direction_[i];
      residual_[i] -= slope / curvature * product_[i];
    }
    for (std::size_t k = 0; k < sizes_.sliders; ++k) at(residual_, k) = across(k, at(residual_, k));
    old_slope = slope;
  }
  return true;
}

/// residual . preconditioner residual
double SlideProjection::weighted_residual(const Step& step) const noexcept {
  double sum = 0;
  for (std::size_t k = 0; k < sizes_.sliders; ++k)
    sum += preconditioner(k, step) * at(residual_, k).squaredNorm();
  return sum;
}

/// Where each slider stands, and whether it is about to leave the rope.
void SlideProjection::find_contacts(const Step& step, std::span<const double> velocities) noexcept {
  const std::size_t last = sizes_.rope_nodes - 2;
  const auto node = [&](std::size_t k) { return Vector3(at(step.positions, k)); };
  for (std::size_t k = 0; k < sizes_.sliders; ++k) {
    const Vector3 C = at(step.positions, sizes_.rope_nodes + k);
    const NearestSegment nearest = nearest_segment(last + 1, node, C);
    Contact& contact = contacts_[k];
    contact.segment = nearest.segment;
    contact.fraction = nearest.fraction;
    contact.violation = std::sqrt(nearest.squared_distance);
    contact.along = (node(nearest.segment + 1) - node(nearest.segment)).normalized();
    contact.at_end = false;
    const bool first_end = nearest.segment == 0 && nearest.fraction <= 0;
    const bool last_end = nearest.segment == last && nearest.fraction >= 1;
    if (first_end || last_end) {
      const double outward = relative(k, velocities).dot(contact.along);
      contact.at_end = first_end ? outward < 0 : outward > 0;
    }
  }
}

/// Velocity changes of all nodes by impulses on the sliders.
void SlideProjection::spread(std::span<const double> impulses, const Step& step) noexcept {
  std::fill(change_.begin(), change_.end(), 0.0);
  for (std::size_t k = 0; k < sizes_.sliders; ++k) {
    const Contact& contact = contacts_[k];
    const Vector3 p = at(impulses, k);
    at(change_, sizes_.rope_nodes + k) += p;
    at(change_, contact.segment) -= (1 - contact.fraction) * p;
    at(change_, contact.segment + 1) -= contact.fraction * p;
  }
  for (std::size_t i = 0; i < change_.size(); ++i) change_[i] *= step.inverse_masses[i];
}

/// The slider's value less the rope's at its foot.
Vector3 SlideProjection::relative(std::size_t slider, std::span<const double> node_values) const noexcept {
  const auto& [segment, t, at_end, violation, along] = contacts_[slider];
  return at(node_values, sizes_.rope_nodes + slider) - (1 - t) * at(node_values, segment) -
         t * at(node_values, segment + 1);
}

Vector3 SlideProjection::across(std::size_t slider, const Vector3& v) const noexcept {
  const Contact& contact = contacts_[slider];
  return contact.at_end ? v : Vector3(v - contact.along * contact.along.dot(v));
}

/// Roughly the mass that an impulse on the slider moves (kg).
double SlideProjection::preconditioner(std::size_t slider, const Step& step) const noexcept {
  const auto& [segment, t, at_end, violation, along] = contacts_[slider];
  const double lightness = at(step.inverse_masses, sizes_.rope_nodes + slider).sum() +
                           (1 - t) * (1 - t) * at(step.inverse_masses, segment).sum() +
                           t * t * at(step.inverse_masses, segment + 1).sum();
  return 3 / lightness;
}

double SlideProjection::largest_violation() const noexcept {
  double largest = 0;
  for (const Contact& contact : contacts_) largest = std::max(largest, contact.violation);
  return largest;
}

}  // namespace talus::fem
