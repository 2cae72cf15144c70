#include "coupler/schemes/unknowns.hpp"

#include <algorithm>

namespace talus::coupler {
namespace {

void copy(std::span<const double> from, std::span<double> to) {
  std::copy(from.begin(), from.end(), to.begin());
}

void scale(std::span<double> values, double factor) {
  for (double& value : values) value *= factor;
}

void copy_scaled(std::span<const double> from, double factor, std::span<double> to) {
  for (std::size_t i = 0; i < from.size(); ++i) to[i] = factor * from[i];
}

/// The structure's motion on the boundary, as the pair (u, L v).
void gather_motion(Exchange& exchange, double length, std::span<double> motion) {
  const std::size_t half = motion.size() / 2;
  exchange.mapping().to_boundary(exchange.structure().displacement, motion.first(half));
  exchange.mapping().to_boundary(exchange.structure().velocity, motion.last(half));
  scale(motion.last(half), length);
}

void set_boundary_end(Exchange& exchange, double length, std::span<const double> motion) {
  const std::size_t half = motion.size() / 2;
  copy(motion.first(half), exchange.particles().end_displacement);
  copy_scaled(motion.last(half), 1 / length, exchange.particles().end_velocity);
}

void predict_motion(Exchange& exchange, const Window& window, Predictor predictor, std::span<double> motion) {
  const auto& boundary = exchange.particles();
  const std::size_t half = motion.size() / 2;
  const double path = predictor == Predictor::linear ? window.length() : 0;
  for (std::size_t i = 0; i < half; ++i) {
    motion[i] = boundary.displacement[i] + path * boundary.velocity[i];
    motion[half + i] = window.length() * boundary.velocity[i];
  }
}

/// Of the pair (u, L v) and of the force.
struct Iterates {
  std::span<const double> motion, made, force, made_force;
};
std::array<FieldChange, 3> changes_of(const Iterates& i, const Window& window) {
  const std::size_t half = i.motion.size() / 2;
  return {FieldChange{FieldName::displacement, i.motion.first(half), i.made.first(half)},
          FieldChange{FieldName::velocity, i.motion.last(half), i.made.last(half), 1 / window.length()},
          FieldChange{FieldName::force, i.force, i.made_force}};
}

}  // namespace

MotionUnknown::MotionUnknown(Exchange& exchange)
    : exchange_(exchange),
      x_(2 * exchange.particles().force.size()),
      made_(x_.size()),
      force_before_(x_.size() / 2) {}

void MotionUnknown::predict(const Window& window, Predictor predictor) {
  predict_motion(exchange_, window, predictor, x_);
  copy(exchange_.particles().force, force_before_);
}

void MotionUnknown::evaluate(const Window& window, int iteration) {
  if (iteration > 0) copy(exchange_.particles().force, force_before_);
  set_boundary_end(exchange_, window.length(), x_);
  exchange_.advance_particles(window, iteration);
  exchange_.load_structure(exchange_.particles().force);
  exchange_.advance_structure(window, iteration);
  gather_motion(exchange_, window.length(), made_);
}

std::array<FieldChange, 3> MotionUnknown::changes(const Window& window) const {
  return changes_of({x_, made_, force_before_, exchange_.particles().force}, window);
}

FreeMotionUnknown::FreeMotionUnknown(Exchange& exchange)
    : exchange_(exchange),
      x_(2 * exchange.particles().force.size()),
      made_(x_.size()),
      structure_motion_(x_.size()),
      boundary_motion_(x_.size()),
      force_before_(x_.size() / 2) {}

void FreeMotionUnknown::predict(const Window& window, Predictor predictor) {
  predict_motion(exchange_, window, predictor, x_);
  copy(exchange_.particles().force, force_before_);
}

void FreeMotionUnknown::evaluate(const Window& window, int iteration) {
  auto& boundary = exchange_.particles();
  const std::size_t half = x_.size() / 2;
  if (iteration > 0) copy(boundary.force, force_before_);
  set_boundary_end(exchange_, window.length(), x_);
  exchange_.advance_particles(window, iteration);
  // From here on the end is where the boundary went: the path of its work.
  copy(boundary.moved_displacement, boundary.end_displacement);
  copy(boundary.moved_velocity, boundary.end_velocity);
  copy(boundary.end_displacement, std::span(boundary_motion_).first(half));
  copy_scaled(boundary.end_velocity, window.length(), std::span(boundary_motion_).last(half));
  exchange_.load_structure(boundary.force);
  exchange_.advance_structure(window, iteration);
  gather_motion(exchange_, window.length(), structure_motion_);
  for (std::size_t i = 0; i < x_.size(); ++i) made_[i] = x_[i] + (structure_motion_[i] - boundary_motion_[i]);
}

std::array<FieldChange, 3> FreeMotionUnknown::changes(const Window& window) const {
  return changes_of({boundary_motion_, structure_motion_, force_before_, exchange_.particles().force},
                    window);
}

ForceUnknown::ForceUnknown(Exchange& exchange)
    : exchange_(exchange),
      x_(exchange.particles().force.size()),
      displacement_before_(x_.size()),
      velocity_before_(x_.size()) {}

void ForceUnknown::predict(const Window& window, Predictor predictor) {
  // The last window's force is the constant prediction; nothing better is known of a contact.
  copy(exchange_.particles().force, x_);
  std::vector<double> motion(2 * x_.size());
  predict_motion(exchange_, window, predictor, motion);
  set_boundary_end(exchange_, window.length(), motion);
}

void ForceUnknown::evaluate(const Window& window, int iteration) {
  auto& boundary = exchange_.particles();
  copy(boundary.end_displacement, displacement_before_);
  copy(boundary.end_velocity, velocity_before_);
  exchange_.load_structure(x_);
  exchange_.advance_structure(window, iteration);
  exchange_.motion_to_boundary_end();
  exchange_.advance_particles(window, iteration);
}

std::array<FieldChange, 3> ForceUnknown::changes(const Window&) const {
  const auto& boundary = exchange_.particles();
  return {FieldChange{FieldName::displacement, displacement_before_, boundary.end_displacement},
          FieldChange{FieldName::velocity, velocity_before_, boundary.end_velocity},
          FieldChange{FieldName::force, x_, boundary.force}};
}

MotionAndForceUnknown::MotionAndForceUnknown(Exchange& exchange, double node_mass)
    : exchange_(exchange),
      node_mass_(node_mass),
      x_(3 * exchange.particles().force.size()),
      made_(x_.size()),
      force_(x_.size() / 3) {}

void MotionAndForceUnknown::predict(const Window& window, Predictor predictor) {
  const std::size_t third = force_.size();
  predict_motion(exchange_, window, predictor, std::span(x_).first(2 * third));
  copy_scaled(exchange_.particles().force, force_scale(window), std::span(x_).last(third));
}

void MotionAndForceUnknown::evaluate(const Window& window, int iteration) {
  const std::size_t third = force_.size();
  set_boundary_end(exchange_, window.length(), std::span(x_).first(2 * third));
  copy_scaled(std::span(x_).last(third), 1 / force_scale(window), force_);
  exchange_.load_structure(force_);
  exchange_.advance_both(window, iteration);
  gather_motion(exchange_, window.length(), std::span(made_).first(2 * third));
  copy_scaled(exchange_.particles().force, force_scale(window), std::span(made_).last(third));
}

std::array<FieldChange, 3> MotionAndForceUnknown::changes(const Window& window) const {
  const std::span<const double> x(x_), made(made_);
  const std::size_t third = force_.size();
  return {FieldChange{FieldName::displacement, x.first(third), made.first(third)},
          FieldChange{FieldName::velocity, x.subspan(third, third), made.subspan(third, third),
                      1 / window.length()},
          FieldChange{FieldName::force, x.last(third), made.last(third), 1 / force_scale(window)}};
}

}  // namespace talus::coupler
