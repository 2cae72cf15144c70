#include "dem_solver/boundary/touching_features.hpp"

#include <algorithm>

namespace talus::dem {

namespace {

/// Shared points computed from two features differ by this much at most, relative to the distance.
constexpr double round_off = 1e-9;

double weight(const Weights& weights, int corner) noexcept {
  return corner == 0 ? weights.a : corner == 1 ? weights.b : weights.c;
}

bool has_node(const Feature& feature, Index node) noexcept {
  return feature.nodes[0] == node || feature.nodes[1] == node || feature.nodes[2] == node;
}

int corners_of(const Feature& feature) noexcept {
  return feature.is_segment() ? 2 : 3;
}

/// Whether the point with these weights lies on the other feature, too.
bool shares_point(const Feature& feature, const Weights& weights, const Feature& other) noexcept {
  for (int k = 0; k < corners_of(feature); ++k)
    if (weight(weights, k) > 0 && !has_node(other, feature.nodes[k])) return false;
  return true;
}

/// The nearest point of a node or edge, as a point of a feature that has it.
FeatureSaddle saddle_at(const Boundary& boundary, const Triple<double>& centre,
                        const std::array<Index, 2>& nodes, Index feature) noexcept {
  const Triple<double> a = boundary.position(nodes[0]), b = boundary.position(nodes[1]);
  const Weights along = nodes[0] == nodes[1] ? Weights{1, 0, 0} : closest_on_segment(centre, a, b);
  const Triple<double> out = centre - (a + along.b * (b - a));
  const Feature& owner = boundary.features()[feature];
  FeatureSaddle saddle{.normal = (1 / length(out)) * out, .weights = {}, .feature = feature};
  const auto share = [&](Index node) {
    return node == nodes[0] ? along.a : node == nodes[1] ? along.b : 0.0;
  };
  saddle.weights = {share(owner.nodes[0]), share(owner.nodes[1]),
                    owner.is_segment() ? 0.0 : share(owner.nodes[2])};
  return saddle;
}

double distance_to(const Boundary& boundary, const Triple<double>& centre,
                   const std::array<Index, 2>& nodes) noexcept {
  const Triple<double> a = boundary.position(nodes[0]);
  if (nodes[0] == nodes[1]) return length(centre - a);
  const Triple<double> b = boundary.position(nodes[1]);
  return length(centre - (a + closest_on_segment(centre, a, b).b * (b - a)));
}

}  // namespace

void TouchSearch::reserve(std::size_t candidates) {
  touches_.reserve(candidates);
  shared_.reserve(6 * candidates);
  links_.reserve(6 * candidates);
  parent_.reserve(candidates);
}

std::span<const FeatureTouch> TouchSearch::find(const Boundary& boundary, const Row& sphere,
                                                std::span<const Index> candidates,
                                                ContactRule rule) noexcept {
  touches_.clear();
  const Triple<double> centre = triple<double>(sphere);
  for (Index k : candidates) {
    const Feature& feature = boundary.features()[k];
    const Boundary::ClosestPoint closest = boundary.closest(feature, centre);
    const Triple<double> out = centre - closest.point;
    const double axis_distance = length(out);
    const double distance = axis_distance - feature.wire_radius;
    if (distance >= sphere.w || axis_distance <= 0) continue;
    touches_.push_back({distance, (1 / axis_distance) * out, closest.weights, k, sphere.w, {}});
  }
  std::ranges::sort(touches_, [](const FeatureTouch& a, const FeatureTouch& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.feature < b.feature;
  });
  if (touches_.size() > 1) {
    if (rule == ContactRule::tangent_plane)
      drop_those_beyond_tangent_planes();
    else
      keep_local_minima(boundary, sphere);
  }
  return touches_;
}

void TouchSearch::drop_those_beyond_tangent_planes() noexcept {
  std::size_t accepted = 0;
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    const bool repeats =
        std::any_of(touches_.begin(), touches_.begin() + accepted, [&](const FeatureTouch& nearer) {
          return dot(touches_[k].normal, nearer.normal) * touches_[k].distance >=
                 nearer.distance * (1 - round_off);
        });
    if (!repeats) touches_[accepted++] = touches_[k];
  }
  touches_.resize(accepted);
}

void TouchSearch::keep_local_minima(const Boundary& boundary, const Row& sphere) noexcept {
  if (is_only_minimum(boundary)) {
    touches_.resize(1);
    return;
  }
  find_links(boundary, sphere);
  limit_by_saddles(boundary, sphere);
}

/// Whether every touch but the first has its nearest point on a nearer one, from where the way leads further down: the usual
/// case of a sphere on a floor, without a search for saddles.
bool TouchSearch::is_only_minimum(const Boundary& boundary) const noexcept {
  for (std::size_t k = 1; k < touches_.size(); ++k) {
    const Feature& own = boundary.features()[touches_[k].feature];
    const bool leads_down =
        std::any_of(touches_.begin(), touches_.begin() + k, [&](const FeatureTouch& nearer) {
          return shares_point(own, touches_[k].weights, boundary.features()[nearer.feature]);
        });
    if (!leads_down) return false;
  }
  return true;
}

void TouchSearch::find_links(const Boundary& boundary, const Row& sphere) noexcept {
  shared_.clear();
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    const Feature& feature = boundary.features()[touches_[k].feature];
    const int corners = corners_of(feature);
    for (int c = 0; c < corners; ++c) {
      const Index node = feature.nodes[c], next = feature.nodes[(c + 1) % 3];
      shared_.push_back({{node, node}, static_cast<Index>(k)});
      if (corners == 3)
        shared_.push_back({{std::min(node, next), std::max(node, next)}, static_cast<Index>(k)});
    }
  }
  std::ranges::sort(shared_, [](const Shared& a, const Shared& b) {
    return a.nodes != b.nodes ? a.nodes < b.nodes : a.touch < b.touch;
  });
  links_.clear();
  const Triple<double> centre = triple<double>(sphere);
  for (std::size_t begin = 0, end = 0; begin < shared_.size(); begin = end) {
    while (end < shared_.size() && shared_[end].nodes == shared_[begin].nodes) ++end;
    if (end - begin < 2) continue;
    const double axis_distance = distance_to(boundary, centre, shared_[begin].nodes);
    for (std::size_t k = begin + 1; k < end; ++k) {
      const Index first = shared_[begin].touch, second = shared_[k].touch;
      const double level =
          axis_distance - std::min(boundary.features()[touches_[first].feature].wire_radius,
                                   boundary.features()[touches_[second].feature].wire_radius);
      if (level < sphere.w) links_.push_back({level, first, second, shared_[begin].nodes});
    }
  }
  std::ranges::sort(links_, [](const Link& a, const Link& b) {
    return a.level != b.level ? a.level < b.level : a.nodes < b.nodes;
  });
}

Index TouchSearch::root_of(Index touch) noexcept {
  while (parent_[touch] != touch) touch = parent_[touch] = parent_[parent_[touch]];
  return touch;
}

/// Raises the level from the nearest point on: where two valleys meet, the shallower one ends. A valley's root is its
/// lowest touch, which comes first.
void TouchSearch::limit_by_saddles(const Boundary& boundary, const Row& sphere) noexcept {
  parent_.clear();
  for (std::size_t k = 0; k < touches_.size(); ++k) parent_.push_back(static_cast<Index>(k));
  for (const Link& link : links_) {
    const auto [deeper, shallower] = std::minmax({root_of(link.first), root_of(link.second)});
    if (deeper == shallower) continue;
    parent_[shallower] = deeper;
    FeatureTouch& ends = touches_[shallower];
    ends.reach = std::max(link.level, ends.distance);
    if (ends.reach > ends.distance * (1 + round_off))
      ends.saddle = saddle_at(boundary, triple<double>(sphere), link.nodes, touches_[link.first].feature);
  }
  std::erase_if(touches_,
                [](const FeatureTouch& touch) { return touch.reach <= touch.distance * (1 + round_off); });
}

}  // namespace talus::dem
