#include "dem_solver/boundary/boundary.hpp"

#include <algorithm>

namespace talus::dem {

Boundary::Boundary(const mesh::Surface& surface, std::span<const Index> material_of_part) {
  const auto nodes = static_cast<std::size_t>(surface.node_count());
  for (std::size_t i = 0; i < nodes; ++i) {
    const double* p = &surface.positions[3 * i];
    reference_.push_back(row({p[0], p[1], p[2]}));
  }
  part_of_node_.assign(nodes, -1);
  for (std::size_t k = 0; k < surface.parts.size(); ++k) {
    const mesh::SurfacePart& part = surface.parts[k];
    const Feature common{.wire_radius = 0, .material = material_of_part[k], .part = static_cast<Index>(k)};
    const auto add = [&](std::array<Index, 3> corners, double wire_radius) {
      Feature feature = common;
      feature.nodes = corners;
      feature.wire_radius = wire_radius;
      for (Index node : corners)
        if (node >= 0) part_of_node_[node] = feature.part;
      features_.push_back(feature);
    };
    part_names_.push_back(part.name);
    for (Index s = part.segment_begin; s < part.segment_end; ++s)
      add({surface.segments[s][0], surface.segments[s][1], -1}, part.wire_radius);
    for (Index t = part.triangle_begin; t < part.triangle_end; ++t) add(surface.triangles[t], 0);
  }
  position_ = reference_;
  velocity_.resize(nodes);
  reaction_.resize(nodes);
}

void Boundary::move(const Motion& motion, double fraction) noexcept {
  const bool starts = motion.end_displacement.empty();
  const auto between = [&](std::span<const double> start, std::span<const double> end, std::size_t i) {
    return starts ? start[i] : start[i] + fraction * (end[i] - start[i]);
  };
  const std::size_t count = motion.start_displacement.size() / 3;
  for (std::size_t i = 0; i < count; ++i) {
    const auto displacement = [&](int k) {
      return between(motion.start_displacement, motion.end_displacement, 3 * i + k);
    };
    const auto velocity = [&](int k) {
      return between(motion.start_velocity, motion.end_velocity, 3 * i + k);
    };
    const std::size_t node = i + motion.first_node;
    const Triple<double> moved{displacement(0), displacement(1), displacement(2)};
    position_[node] = row(triple<double>(reference_[node]) + moved);
    velocity_[node] = row({velocity(0), velocity(1), velocity(2)});
  }
}

void Boundary::displace(const Addition& addition) noexcept {
  for (std::size_t i = 0; i < addition.displacement.size() / 3; ++i) {
    const double *d = &addition.displacement[3 * i], *w = &addition.velocity[3 * i];
    Row &x = position_[i + addition.first_node], &v = velocity_[i + addition.first_node];
    x = row(triple<double>(x) + Triple<double>{d[0], d[1], d[2]});
    v = row(triple<double>(v) + Triple<double>{w[0], w[1], w[2]});
  }
}

void Boundary::set_velocity(Index part, const Triple<double>& velocity) {
  for (Index i = 0; i < node_count(); ++i) {
    if (part_of_node_[i] != part) continue;
    velocity_[i] = row(velocity);
    drifting_.push_back(i);
  }
}

void Boundary::drift(double time) noexcept {
  for (Index i : drifting_)
    position_[i] = row(triple<double>(reference_[i]) + time * triple<double>(velocity_[i]));
}

void Boundary::set_node_masses(std::span<const double> masses, Index first) {
  free_velocity_ = velocity_;
  for (Row& node : free_velocity_) node.w = 0;
  for (std::size_t i = 0; i < masses.size(); ++i)
    free_velocity_[first + i].w = masses[i] > 0 ? 1 / masses[i] : 0;
}

void Boundary::set_free_velocity(std::span<const double> velocity, Index first) noexcept {
  for (std::size_t i = 0; i < velocity.size() / 3; ++i) {
    Row& node = free_velocity_[first + i];
    node = row({velocity[3 * i], velocity[3 * i + 1], velocity[3 * i + 2]}, node.w);
  }
}

void Boundary::clear_reactions() noexcept {
  std::ranges::fill(reaction_, Row{});
}

void Boundary::react(const Feature& feature, const Weights& weights,
                     const Triple<double>& force_on_sphere) noexcept {
  add(reaction_[feature.nodes[0]], -weights.a * force_on_sphere);
  add(reaction_[feature.nodes[1]], -weights.b * force_on_sphere);
  if (!feature.is_segment()) add(reaction_[feature.nodes[2]], -weights.c * force_on_sphere);
}

Boundary::ClosestPoint Boundary::closest(const Feature& feature, const Triple<double>& p) const noexcept {
  const Triple<double> a = triple<double>(position_[feature.nodes[0]]),
                       b = triple<double>(position_[feature.nodes[1]]);
  if (feature.is_segment()) {
    const Weights w = closest_on_segment(p, a, b);
    return {w, a + w.b * (b - a)};
  }
  const Triple<double> c = triple<double>(position_[feature.nodes[2]]);
  const Weights w = closest_on_triangle(p, a, b, c);
  return {w, a + w.b * (b - a) + w.c * (c - a)};
}

Triple<double> Boundary::velocity_at(const Feature& feature, const Weights& weights) const noexcept {
  Triple<double> v = weights.a * triple<double>(velocity_[feature.nodes[0]]) +
                     weights.b * triple<double>(velocity_[feature.nodes[1]]);
  if (!feature.is_segment()) v = v + weights.c * triple<double>(velocity_[feature.nodes[2]]);
  return v;
}

double Boundary::largest_motion(std::span<const Row> since) const noexcept {
  double largest = 0;
  for (std::size_t i = 0; i < position_.size(); ++i) {
    const Triple<double> moved = triple<double>(position_[i]) - triple<double>(since[i]);
    largest = std::max(largest, dot(moved, moved));
  }
  return std::sqrt(largest);
}

}  // namespace talus::dem
