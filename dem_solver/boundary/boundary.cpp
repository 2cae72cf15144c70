#include "dem_solver/boundary/boundary.hpp"

#include <algorithm>
#include <cmath>

namespace talus::dem {

Boundary::Boundary(const mesh::Surface& surface, std::span<const Index> material_of_part) {
  const auto nodes = static_cast<std::size_t>(surface.node_count());
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
    for (Index s = part.segment_begin; s < part.segment_end; ++s) {
      add({surface.segments[s][0], surface.segments[s][1], -1}, part.wire_radius);
      cell_of_feature_.push_back(s);
    }
    for (Index t = part.triangle_begin; t < part.triangle_end; ++t) {
      add(surface.triangles[t], 0);
      cell_of_feature_.push_back(-1 - t);
    }
  }
  reference_ = surface.positions;
  displacement_.resize(reference_.size());
  velocity_.resize(reference_.size());
  reaction_.resize(nodes);
  loaded_nodes_.reserve(nodes);
}

void Boundary::lose(const Cells& cells, std::span<const double> lost) {
  if (lost_.empty() && std::ranges::all_of(lost, [](double value) { return value == 0; })) return;
  lost_.resize(features_.size(), 0);
  bool changed = false;
  for (std::size_t f = 0; f < features_.size(); ++f) {
    const bool segment = cell_of_feature_[f] >= 0;
    const auto cell = static_cast<std::size_t>(segment ? cell_of_feature_[f] : -1 - cell_of_feature_[f]);
    const std::size_t first = segment ? cells.first_segment : cells.first_triangle;
    if (cell < first) continue;  // of the scene's own
    const Index now = lost[cell - first + (segment ? 0 : cells.segments)] != 0 ? 1 : 0;
    changed = changed || now != lost_[f];
    lost_[f] = now;
  }
  losses_ += changed ? 1 : 0;
}

Triple<double> Boundary::Motion::velocity(std::size_t i, double x) const noexcept {
  const auto along = [&](std::size_t c) {
    return (end_displacement[c] - start_displacement[c]) / length +
           (end_velocity[c] - start_velocity[c]) * (x - 0.5);
  };
  return {along(3 * i), along(3 * i + 1), along(3 * i + 2)};
}

void Boundary::move(const Motion& motion, const Moment& moment) noexcept {
  const std::size_t first = 3 * static_cast<std::size_t>(motion.first_node),
                    count = motion.start_displacement.size();
  double *u = displacement_.data() + first, *v = velocity_.data() + first;
  if (motion.end_displacement.empty()) {
    std::ranges::copy(motion.start_displacement, u);
    std::ranges::copy(motion.start_velocity, v);
    return;
  }
  const double x = moment.displacement, bend = 0.5 * motion.length * x * (x - 1), rate = 1 / motion.length,
               turn = moment.velocity - 0.5;
  for (std::size_t i = 0; i < count; ++i) {
    const double way = motion.end_displacement[i] - motion.start_displacement[i],
                 change = motion.end_velocity[i] - motion.start_velocity[i];
    u[i] = motion.start_displacement[i] + x * way + bend * change;
    v[i] = rate * way + turn * change;
  }
}

void Boundary::set(std::vector<double>& values, Index node, const Triple<double>& v) noexcept {
  double* to = values.data() + 3 * static_cast<std::size_t>(node);
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
}

void Boundary::displace(const Addition& addition) noexcept {
  const auto add = [first = 3 * static_cast<std::size_t>(addition.first_node)](
                       std::vector<double>& to, std::span<const double> values) {
    for (std::size_t i = 0; i < values.size(); ++i) to[first + i] += values[i];
  };
  add(displacement_, addition.displacement);
  add(velocity_, addition.velocity);
}

void Boundary::set_velocity(Index part, const Triple<double>& velocity) {
  for (Index i = 0; i < node_count(); ++i) {
    if (part_of_node_[i] != part) continue;
    set(velocity_, i, velocity);
    drifting_.push_back(i);
  }
}

void Boundary::drift(double time) noexcept {
  for (Index i : drifting_) set(displacement_, i, time * velocity(i));
}

void Boundary::set_node_masses(std::span<const double> masses, Index first) {
  free_velocity_.resize(reaction_.size());
  for (Index i = 0; i < node_count(); ++i) free_velocity_[i] = row(velocity(i));
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
  for (Index node : loaded_nodes_) reaction_[node] = {};
  loaded_nodes_.clear();
}

void Boundary::react_at(Index node, const Triple<double>& force) noexcept {
  Row& reaction = reaction_[node];
  if (reaction.w == 0) loaded_nodes_.push_back(node);
  reaction.w = 1;
  add(reaction, force);
}

void Boundary::react(const Feature& feature, const Weights& weights,
                     const Triple<double>& force_on_sphere) noexcept {
  react_at(feature.nodes[0], -weights.a * force_on_sphere);
  react_at(feature.nodes[1], -weights.b * force_on_sphere);
  if (!feature.is_segment()) react_at(feature.nodes[2], -weights.c * force_on_sphere);
}

Boundary::ClosestPoint Boundary::closest(const Feature& feature, const Triple<double>& p) const noexcept {
  const Triple<double> a = position(feature.nodes[0]), b = position(feature.nodes[1]);
  if (feature.is_segment()) {
    const Weights w = closest_on_segment(p, a, b);
    return {w, a + w.b * (b - a)};
  }
  const Triple<double> c = position(feature.nodes[2]);
  const Weights w = closest_on_triangle(p, a, b, c);
  return {w, a + w.b * (b - a) + w.c * (c - a)};
}

Triple<double> Boundary::velocity_at(const Feature& feature, const Weights& weights) const noexcept {
  Triple<double> v = weights.a * velocity(feature.nodes[0]) + weights.b * velocity(feature.nodes[1]);
  if (!feature.is_segment()) v = v + weights.c * velocity(feature.nodes[2]);
  return v;
}

double Boundary::motion_bound(std::span<const double> since) const noexcept {
  // Axis by axis, 8 nodes at a time: a loop of fixed length compiles to a few vector instructions.
  constexpr std::size_t block = 24;
  std::array<double, block> largest{};
  const double *now = displacement_.data(), *then = since.data();
  const std::size_t count = displacement_.size(), whole = count / block * block;
  const auto look = [&](std::size_t begin, std::size_t length) {
    for (std::size_t k = 0; k < length; ++k) {
      const double moved = std::abs(now[begin + k] - then[begin + k]);
      largest[k] = moved > largest[k] ? moved : largest[k];
    }
  };
  for (std::size_t begin = 0; begin < whole; begin += block) look(begin, block);
  look(whole, count - whole);
  Triple<double> most;
  for (std::size_t k = 0; k < block; k += 3)
    most = {larger(most.x, largest[k]), larger(most.y, largest[k + 1]), larger(most.z, largest[k + 2])};
  return length(most);
}

}  // namespace talus::dem
