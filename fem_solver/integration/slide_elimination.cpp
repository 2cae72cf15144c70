#include "fem_solver/integration/slide_elimination.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "fem_solver/constraints/held_directions.hpp"
#include "fem_solver/constraints/nearest_segment.hpp"

namespace talus::fem {
namespace {

std::size_t direction_of(Index node, int axis) {
  return 3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(axis);
}

std::string name_of(const ConstrainedSlide& slide, const Model& model, Index node) {
  return fmt::format("structure.slides.{}: {}", slide.name, node_name(model, node));
}

SparseMatrix sparse(Index size, const std::vector<Eigen::Triplet<double>>& entries) {
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

double largest_diagonal(const SparseMatrix& matrix) {
  return matrix.diagonal().cwiseAbs().maxCoeff();
}

/// The slide whose sliders each node is one of; every node may follow one rope.
std::vector<const ConstrainedSlide*> slides_of_nodes(const Model& model) {
  std::vector<const ConstrainedSlide*> followed(static_cast<std::size_t>(model.nodes()), nullptr);
  for (const auto& slide : model.constrained_slides)
    for (const Index node : slide.line.sliders)
      if (std::exchange(followed[static_cast<std::size_t>(node)], &slide))
        throw core::ConfigError(
            name_of(slide, model, node) +
            " runs on another rope too, which implicit and static runs do not solve; take `penalty`");
  for (const HeldDirection& h : held_directions(model))
    if (const auto* slide = followed[h.direction / 3])
      throw core::ConfigError(
          name_of(*slide, model, static_cast<Index>(h.direction / 3)) +
          " is supported, so it cannot follow a rope in implicit and static runs; take `penalty`");
  return followed;
}

/// How many ropes carry a slide's rope in turn: 0 where none of its nodes runs on another.
std::size_t depth_of(const ConstrainedSlide& slide, const Model& model,
                     const std::vector<const ConstrainedSlide*>& followed, std::size_t below = 0) {
  if (below > model.constrained_slides.size())
    throw core::ConfigError(
        "structure.slides." + slide.name +
        ": its rope runs on ropes that run on it, in a circle, which implicit and static runs do not solve");
  std::size_t depth = 0;
  for (const Index node : slide.line.rope)
    if (const auto* carrier = followed[static_cast<std::size_t>(node)])
      depth = std::max(depth, 1 + depth_of(*carrier, model, followed, below + 1));
  return depth;
}

}  // namespace

SlideElimination::SlideElimination(const Model& model, const Equations& equations)
    : model_(model), equations_(equations) {
  const auto followed = slides_of_nodes(model);
  std::vector<std::pair<std::size_t, const SlideLine*>> lines;  // those that others run on first
  for (const auto& slide : model.constrained_slides)
    lines.emplace_back(depth_of(slide, model, followed), &slide.line);
  std::ranges::stable_sort(lines, {}, [](const auto& line) { return line.first; });
  for (const auto& [depth, line] : lines)
    for (const Index node : line->sliders) sliders_.push_back({line, node});
}

Vector3 SlideElimination::position(std::span<const double> displacement, Index node) const {
  return model_.position(node) + Vector3::Map(&displacement[direction_of(node, 0)]);
}

void SlideElimination::put(const Slider& slider, const Vector3& place, std::span<double> displacement) const {
  Vector3::Map(&displacement[direction_of(slider.node, 0)]) = place - model_.position(slider.node);
}

SlideConstraint SlideElimination::constraint(std::span<const double> displacement,
                                             const Slider& slider) const {
  const Index* rope = &slider.line->rope[slider.segment];
  return SlideConstraint({position(displacement, rope[0]), position(displacement, rope[1]),
                          position(displacement, slider.node)});
}

void SlideElimination::start(std::span<double> displacement) {
  for (Slider& slider : sliders_) {
    const auto node = [&](std::size_t k) { return position(displacement, slider.line->rope[k]); };
    slider.segment =
        nearest_segment(slider.line->rope.size() - 1, node, position(displacement, slider.node)).segment;
    slider.held = false;
  }
  follow(displacement);
}

void SlideElimination::follow(std::span<double> displacement) {
  for (Slider& slider : sliders_) {
    if (!slider.held) {
      const double fraction = constraint(displacement, slider).fraction;
      slider.corner.reset();
      if (fraction <= 0) slider.corner = slider.segment;
      if (fraction >= 1) slider.corner = slider.segment + 1;
    }
    if (slider.corner) {
      put(slider, position(displacement, slider.line->rope[*slider.corner]), displacement);
      continue;
    }
    const SlideConstraint here = constraint(displacement, slider);
    for (std::size_t i = 0; i < 2; ++i)
      displacement[direction_of(slider.node, here.slaves[i])] -= here.offsets[i];
  }
}

void SlideElimination::settle(std::span<const double> displacement, std::span<double> residual) {
  followers_.clear();
  curvature_.clear();
  // What runs on a rope gives it its force first.
  for (auto next = sliders_.rbegin(); next != sliders_.rend(); ++next) {
    Slider& slider = *next;
    const Vector3 force = Vector3::Map(&residual[direction_of(slider.node, 0)]);
    const std::size_t first = followers_.size();
    if (slider.corner) leave_corner(displacement, force, slider);
    if (slider.held) {
      add_followers_of_corner(slider);
    } else {
      const SlideConstraint here = constraint(displacement, slider);
      add_followers(slider, here);
      add_curvature(slider, here, force);
    }
    for (std::size_t k = first; k < followers_.size(); ++k) followers_[k].carry(residual);
  }
}

/// To the neighbouring segment along which the force points away from the corner, if there is one.
void SlideElimination::leave_corner(std::span<const double> displacement, const Vector3& force,
                                    Slider& slider) const {
  const auto& rope = slider.line->rope;
  const std::size_t last = rope.size() - 1;
  const bool closed = rope.front() == rope.back();
  const Vector3 here = position(displacement, rope[*slider.corner]);
  const auto force_towards = [&](std::size_t neighbour) {
    return force.dot((position(displacement, rope[neighbour]) - here).normalized());
  };
  const std::size_t start =
      closed && *slider.corner == last ? 0 : *slider.corner;  // of the segment behind the corner
  const std::size_t end = closed && *slider.corner == 0 ? last : *slider.corner;  // of the one before it
  const double back = end > 0 ? force_towards(end - 1) : 0;
  const double onwards = start < last ? force_towards(start + 1) : 0;
  slider.held = onwards <= 0 && back <= 0;
  if (!slider.held) slider.segment = onwards >= back ? start : end - 1;
}

void SlideElimination::add_followers(const Slider& slider, const SlideConstraint& constraint) {
  const Index A = slider.line->rope[slider.segment], B = slider.line->rope[slider.segment + 1];
  for (std::size_t i = 0; i < 2; ++i) {
    const auto [slave, weights, offset] = constraint.row(i);
    followers_.push_back(
        {direction_of(slider.node, slave),
         {direction_of(A, slave), direction_of(B, slave), direction_of(slider.node, constraint.pivot),
          direction_of(A, constraint.pivot), direction_of(B, constraint.pivot)},
         weights,
         5});
  }
}

void SlideElimination::add_followers_of_corner(const Slider& slider) {
  for (int axis = 0; axis < 3; ++axis)
    followers_.push_back(
        {direction_of(slider.node, axis), {direction_of(slider.line->rope[*slider.corner], axis)}, {1}, 1});
}

void SlideElimination::add_curvature(const Slider& slider, const SlideConstraint& constraint,
                                     const Vector3& force) {
  const std::array<Index, 3> nodes{slider.line->rope[slider.segment], slider.line->rope[slider.segment + 1],
                                   slider.node};
  const SlideConstraint::Curvature curvature =
      constraint.curvature({force[constraint.slaves[0]], force[constraint.slaves[1]]});
  const auto equation = [&](int i) {
    return equations_.of(direction_of(nodes[static_cast<std::size_t>(i / 3)], i % 3));
  };
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j)
      if (curvature(i, j) != 0 && equation(j) >= 0 && equation(i) >= equation(j))
        curvature_.emplace_back(equation(i), equation(j), -curvature(i, j));
}

void SlideElimination::Follower::carry(std::span<double> force) const {
  for (std::size_t k = 0; k < count; ++k) force[masters[k]] += weights[k] * force[direction];
  force[direction] = 0;
}

void SlideElimination::carry_over(std::span<double> force) const {
  for (const Follower& follower : followers_) follower.carry(force);
}

void SlideElimination::lead(std::span<double> rates) const {
  for (auto next = followers_.rbegin(); next != followers_.rend(); ++next) {
    const auto& [direction, masters, weights, count] = *next;
    rates[direction] = 0;
    for (std::size_t k = 0; k < count; ++k) rates[direction] += weights[k] * rates[masters[k]];
  }
}

SparseMatrix SlideElimination::condense(const SparseMatrix& matrix) const {
  return condense(matrix, largest_diagonal(matrix));
}

SparseMatrix SlideElimination::condense(const SparseMatrix& matrix, double unit) const {
  const Index size = equations_.count();
  std::vector<bool> follows(static_cast<std::size_t>(size), false);
  std::vector<Eigen::Triplet<double>> weights, ones;
  for (const Follower& follower : followers_) {
    const Index row = equations_.of(follower.direction);
    follows[static_cast<std::size_t>(row)] = true;
    ones.emplace_back(row, row, unit);
    for (std::size_t k = 0; k < follower.count; ++k)
      if (const Index column = equations_.of(follower.masters[k]); column >= 0)
        weights.emplace_back(row, column, follower.weights[k]);
  }
  for (Index k = 0; k < size; ++k)
    if (!follows[static_cast<std::size_t>(k)]) weights.emplace_back(k, k, 1);
  const SparseMatrix one_by_one = sparse(size, weights), whole = matrix.selfadjointView<Eigen::Lower>();
  const auto leans_on_followers = [&](const SparseMatrix& L) {
    for (const Follower& follower : followers_)
      if (L.col(equations_.of(follower.direction)).nonZeros() > 0) return true;
    return false;
  };
  SparseMatrix L = one_by_one;
  while (leans_on_followers(L)) L = SparseMatrix(L * one_by_one).pruned();  // a rope runs on another
  const SparseMatrix condensed = SparseMatrix(L.transpose() * whole) * L;
  return SparseMatrix(condensed.triangularView<Eigen::Lower>()) + sparse(size, ones);
}

SparseMatrix SlideElimination::condense_with_curvature(const SparseMatrix& tangent) const {
  const SparseMatrix curved = tangent + sparse(equations_.count(), curvature_);
  return condense(curved, largest_diagonal(tangent));
}

double SlideElimination::gap(std::size_t slide, std::span<const double> displacement) const {
  const SlideLine& line = model_.constrained_slides[slide].line;
  const auto node = [&](std::size_t k) { return position(displacement, line.rope[k]); };
  double largest = 0;
  for (const Index slider : line.sliders)
    largest = std::max(
        largest,
        nearest_segment(line.rope.size() - 1, node, position(displacement, slider)).squared_distance);
  return std::sqrt(largest);
}

}  // namespace talus::fem
