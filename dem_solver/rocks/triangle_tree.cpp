#include "dem_solver/rocks/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "dem_solver/boundary/closest_point.hpp"

namespace talus::dem {

namespace {

constexpr std::int32_t leaf_size = 2;
/// Halving 2^31 triangles ends at depth 29; each level leaves one node waiting.
constexpr std::size_t deepest = 32;
/// Boxes as far as the nearest triangle are still opened, so that round-off cannot hide an equal one.
constexpr double round_off = 1 + 1e-12;

double distance_to(const Triple<double>& point, const Triple<double>& a, const Triple<double>& b,
                   const Triple<double>& c) noexcept {
  const Weights w = closest_on_triangle(point, a, b, c);
  return length(w.a * (a - point) + w.b * (b - point) + w.c * (c - point));
}

double outside(double x, double low, double high) noexcept {
  return std::max({low - x, x - high, 0.0});
}

}  // namespace

bool TriangleTree::Box::touches(const Box& other) const noexcept {
  return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y &&
         low.z <= other.high.z && other.low.z <= high.z;
}

TriangleTree::TriangleTree(const mesh::Surface& surface)
    : surface_(surface), order_(surface.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(order_.size());
  build(0, static_cast<std::int32_t>(order_.size()));
  faces_.reserve(order_.size());
  for (const std::int32_t triangle : order_) faces_.push_back(corners(triangle));
}

TriangleTree::Corners TriangleTree::corners(std::int32_t triangle) const noexcept {
  const auto corner = [&](int k) {
    const double* x = &surface_.positions[3 * surface_.triangles[triangle][k]];
    return Triple<double>{x[0], x[1], x[2]};
  };
  return {corner(0), corner(1), corner(2)};
}

TriangleTree::Box TriangleTree::box_of(std::int32_t triangle) const noexcept {
  const auto& [a, b, c] = corners(triangle);
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

void TriangleTree::build(std::int32_t begin, std::int32_t end) {
  const std::size_t self = nodes_.size();
  Box box = box_of(order_[begin]);
  for (std::int32_t i = begin + 1; i < end; ++i) {
    const Box more = box_of(order_[i]);
    box.low = {std::min(box.low.x, more.low.x), std::min(box.low.y, more.low.y),
               std::min(box.low.z, more.low.z)};
    box.high = {std::max(box.high.x, more.high.x), std::max(box.high.y, more.high.y),
                std::max(box.high.z, more.high.z)};
  }
  nodes_.push_back({box, 0, begin, end - begin <= leaf_size ? end - begin : 0});
  if (end - begin <= leaf_size) return;

  const Triple<double> size = box.high - box.low;
  double Triple<double>::*const axis = size.x >= std::max(size.y, size.z) ? &Triple<double>::x
                                       : size.y >= size.z                 ? &Triple<double>::y
                                                                          : &Triple<double>::z;
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::int32_t i, std::int32_t j) {
                     const Box a = box_of(i), b = box_of(j);
                     return a.low.*axis + a.high.*axis < b.low.*axis + b.high.*axis;
                   });
  build(begin, middle);
  nodes_[self].right = static_cast<std::int32_t>(nodes_.size());
  build(middle, end);
}

double TriangleTree::distance(const Triple<double>& point, std::int32_t& hint) const noexcept {
  const auto to_face = [&](std::int32_t place) {
    const Corners& face = faces_[place];
    return distance_to(point, face.a, face.b, face.c);
  };
  double best = to_face(hint);
  const auto squared_to_box = [&](std::int32_t node) {
    const Box& box = nodes_[node].box;
    const Triple<double> d{outside(point.x, box.low.x, box.high.x), outside(point.y, box.low.y, box.high.y),
                           outside(point.z, box.low.z, box.high.z)};
    return dot(d, d);
  };
  std::array<std::pair<double, std::int32_t>, deepest> waiting;
  std::size_t count = 0;
  waiting[count++] = {squared_to_box(0), 0};
  while (count > 0) {
    const auto [away, next] = waiting[--count];
    if (away > best * best * round_off) continue;
    const Node& node = nodes_[next];
    for (std::int32_t i = node.begin; i < node.begin + node.count; ++i)
      if (const double here = to_face(i); here < best) {
        best = here;
        hint = i;
      }
    if (node.count > 0) continue;
    std::pair near{squared_to_box(next + 1), next + 1}, far{squared_to_box(node.right), node.right};
    if (far.first < near.first) std::swap(near, far);
    waiting[count++] = far;
    waiting[count++] = near;
  }
  return best;
}

}  // namespace talus::dem
