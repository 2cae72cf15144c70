#include "fem_solver/constraints/slide_projection.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fem_solver/constraints/nearest_segment.hpp"

namespace talus::fem {
namespace {

/// Of what leads sliders off their ropes, relative to the numbers that it is a difference of.
constexpr double closeness = 1e-13;

/// The 3-vector of a node in an array of many, to read or to write.
template <class Array>
auto at_node(Array&& values, std::size_t node) noexcept {
  return Eigen::Map<std::conditional_t<std::is_const_v<std::remove_reference_t<decltype(values[0])>>,
                                       const Vector3, Vector3>>(&values[3 * node]);
}

double dot(std::span<const double> a, std::span<const double> b) noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

SlideProjection::SlideProjection(SlideNetwork network)
    : network_(std::move(network)),
      contacts_(network_.sliders.size()),
      impulse_(3 * contacts_.size()),
      residual_(impulse_.size()),
      direction_(impulse_.size()),
      product_(impulse_.size()),
      change_(3 * network_.nodes) {}

void SlideProjection::search(const Place& at) const noexcept {
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const auto& rope = network_.ropes[network_.sliders[k].rope];
    const auto node = [&](std::size_t i) { return Vector3(at_node(at.positions, rope[i])); };
    at.segments[k] = static_cast<double>(
        nearest_segment(rope.size() - 1, node, at_node(at.positions, network_.sliders[k].node)).segment);
  }
}

bool SlideProjection::stop(const Place& at, std::span<const double> inverse_masses,
                           std::span<double> velocities) noexcept {
  double squares = 0;
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const double beyond = find(at, k);
    Contact& contact = contacts_[k];
    contact.at_end = beyond != 0 && beyond * relative(k, velocities).dot(contact.along) > 0;
    at_node(residual_, k) = across(k, -relative(k, velocities));
    squares += at_node(velocities, network_.sliders[k].node).squaredNorm() +
               at_node(velocities, contact.near).squaredNorm() +
               at_node(velocities, contact.far).squaredNorm();
  }
  const bool converged = solve(inverse_masses, closeness * closeness * squares);
  spread(impulse_, inverse_masses);
  for (std::size_t i = 0; i < change_.size(); ++i) velocities[i] += change_[i];
  return converged;
}

bool SlideProjection::put_back(const Place& at, std::span<const double> inverse_masses,
                               std::span<double> moves) noexcept {
  double squares = 0;
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    contacts_[k].at_end = find(at, k) != 0;
    at_node(residual_, k) = across(k, -relative(k, at.positions));
    squares += at_node(at.positions, network_.sliders[k].node).squaredNorm() +
               at_node(at.positions, contacts_[k].near).squaredNorm();
  }
  const bool converged = solve(inverse_masses, closeness * closeness * squares);
  spread(impulse_, inverse_masses);
  std::ranges::copy(change_, moves.begin());
  return converged;
}

double SlideProjection::find(const Place& at, std::size_t slider) noexcept {
  const auto& rope = network_.ropes[network_.sliders[slider].rope];
  const auto node = [&](std::size_t i) { return Vector3(at_node(at.positions, rope[i])); };
  const Vector3 C = at_node(at.positions, network_.sliders[slider].node);
  const std::size_t last = rope.size() - 2;
  const bool closed = rope.front() == rope.back();
  const NearestSegment nearest =
      nearest_segment_from(static_cast<std::size_t>(at.segments[slider]), {last + 1, closed}, node, C);
  at.segments[slider] = static_cast<double>(nearest.segment);
  Contact& contact = contacts_[slider];
  contact.near = rope[nearest.segment];
  contact.far = rope[nearest.segment + 1];
  contact.fraction = nearest.fraction;
  contact.violation = std::sqrt(nearest.squared_distance);
  contact.along = (node(nearest.segment + 1) - node(nearest.segment)).normalized();
  if (closed) return 0;
  if (nearest.segment == 0 && nearest.fraction <= 0) return -1;
  if (nearest.segment == last && nearest.fraction >= 1) return 1;
  return 0;
}

// The system is singular along the ropes. Residuals are therefore turned across them anew each time: what
// round-off leaves along a rope would be divided by round-off and come back as an impulse of any size.
bool SlideProjection::solve(std::span<const double> inverse_masses, double enough) noexcept {
  std::ranges::fill(impulse_, 0.0);
  const std::size_t most_steps = 20 * contacts_.size() + 20;
  double old_slope = 0;
  for (std::size_t count = 0; dot(residual_, residual_) > enough; ++count) {
    const double slope = weighted_residual(inverse_masses);
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      at_node(direction_, k) *= count == 0 ? 0 : slope / old_slope;
      at_node(direction_, k) += preconditioner(k, inverse_masses) * at_node(residual_, k);
    }
    spread(direction_, inverse_masses);
    for (std::size_t k = 0; k < contacts_.size(); ++k) at_node(product_, k) = across(k, relative(k, change_));
    const double curvature = dot(direction_, product_);
    if (count == most_steps || !(curvature > 0)) return false;
    for (std::size_t i = 0; i < impulse_.size(); ++i) {
      impulse_[i] += slope / curvature * direction_[i];
      residual_[i] -= slope / curvature * product_[i];
    }
    for (std::size_t k = 0; k < contacts_.size(); ++k)
      at_node(residual_, k) = across(k, at_node(residual_, k));
    old_slope = slope;
  }
  return true;
}

/// residual . preconditioner residual
double SlideProjection::weighted_residual(std::span<const double> inverse_masses) const noexcept {
  double sum = 0;
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    sum += preconditioner(k, inverse_masses) * at_node(residual_, k).squaredNorm();
  return sum;
}

/// Changes of all nodes by impulses on the sliders.
void SlideProjection::spread(std::span<const double> impulses,
                             std::span<const double> inverse_masses) noexcept {
  std::ranges::fill(change_, 0.0);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const Contact& contact = contacts_[k];
    const Vector3 p = at_node(impulses, k);
    at_node(change_, network_.sliders[k].node) += p;
    at_node(change_, contact.near) -= (1 - contact.fraction) * p;
    at_node(change_, contact.far) -= contact.fraction * p;
  }
  for (std::size_t i = 0; i < change_.size(); ++i) change_[i] *= inverse_masses[i];
}

/// The slider's value less the rope's at its foot.
Vector3 SlideProjection::relative(std::size_t slider, std::span<const double> node_values) const noexcept {
  const Contact& contact = contacts_[slider];
  return at_node(node_values, network_.sliders[slider].node) -
         (1 - contact.fraction) * at_node(node_values, contact.near) -
         contact.fraction * at_node(node_values, contact.far);
}

Vector3 SlideProjection::across(std::size_t slider, const Vector3& v) const noexcept {
  const Contact& contact = contacts_[slider];
  return contact.at_end ? v : Vector3(v - contact.along * contact.along.dot(v));
}

/// Roughly the mass that an impulse on the slider moves (kg).
double SlideProjection::preconditioner(std::size_t slider,
                                       std::span<const double> inverse_masses) const noexcept {
  const Contact& contact = contacts_[slider];
  const double t = contact.fraction;
  const double lightness = at_node(inverse_masses, network_.sliders[slider].node).sum() +
                           (1 - t) * (1 - t) * at_node(inverse_masses, contact.near).sum() +
                           t * t * at_node(inverse_masses, contact.far).sum();
  return 3 / lightness;
}

}  // namespace talus::fem
