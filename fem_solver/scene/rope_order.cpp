#include "fem_solver/scene/rope_order.hpp"

#include <algorithm>
#include <optional>

namespace talus::fem {

namespace {

Vector3 middle_of(const std::vector<Index>& nodes, const Model& model) {
  Vector3 sum = Vector3::Zero();
  for (const Index node : nodes) sum += model.position(node);
  return sum / static_cast<double>(nodes.size());
}

/// From the middle to the node furthest from it.
Vector3 longest_direction(const std::vector<Index>& nodes, const Model& model) {
  const Vector3 middle = middle_of(nodes, model);
  Vector3 longest = Vector3::Zero();
  for (const Index node : nodes)
    if (const Vector3 arm = model.position(node) - middle; arm.squaredNorm() > longest.squaredNorm())
      longest = arm;
  return longest;
}

/// The end of the neighbouring stretch that faces this one; its middle where it has no order yet.
std::optional<Vector3> neighbour(const std::vector<RopeStretch>& stretches, std::size_t number,
                                 const Model& model) {
  if (number >= stretches.size() || stretches[number].nodes.empty()) return std::nullopt;
  const RopeStretch& next = stretches[number];
  return next.has_order ? model.position(next.nodes.front()) : middle_of(next.nodes, model);
}

}  // namespace

void put_in_order(std::vector<RopeStretch>& stretches, const Model& model) {
  std::optional<Vector3> before;
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    RopeStretch& stretch = stretches[k];
    if (stretch.nodes.empty()) continue;
    if (!stretch.has_order) {
      const std::optional<Vector3> after = neighbour(stretches, k + 1, model);
      const Vector3 middle = middle_of(stretch.nodes, model);
      const Vector3 along = before || after ? Vector3(after.value_or(middle) - before.value_or(middle))
                                            : longest_direction(stretch.nodes, model);
      std::ranges::stable_sort(stretch.nodes, {},
                               [&](Index node) { return along.dot(model.position(node)); });
      stretch.has_order = true;
    }
    before = model.position(stretch.nodes.back());
  }
}

double way_along(const std::vector<Index>& nodes, const Model& model) {
  double way = 0;
  for (std::size_t k = 1; k < nodes.size(); ++k)
    way += (model.position(nodes[k]) - model.position(nodes[k - 1])).norm();
  return way;
}

double way_to_nearest(const std::vector<Index>& nodes, const Model& model) {
  std::vector<Index> left = nodes;
  double way = 0;
  while (left.size() > 1) {
    const Vector3 here = model.position(left.front());
    left.front() = left.back();
    left.pop_back();
    const auto distance = [&](Index node) { return (model.position(node) - here).norm(); };
    const auto nearest = std::ranges::min_element(left, {}, distance);
    way += distance(*nearest);
    std::iter_swap(left.begin(), nearest);
  }
  return way;
}

Index first_turn_back(const std::vector<Index>& nodes, const Model& model) {
  constexpr double back = -0.17365;  // cosine of 100 degrees
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
    const Vector3 here = model.position(nodes[k]), before = here - model.position(nodes[k - 1]),
                  after = model.position(nodes[k + 1]) - here;
    if (before.dot(after) < back * before.norm() * after.norm()) return nodes[k];
  }
  return -1;
}

}  // namespace talus::fem
