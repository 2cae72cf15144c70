#include "dem_solver/scene/faces_in_plan.hpp"

#include <cmath>

namespace talus::dem {

namespace {

Triple<double> unit(const Triple<double>& v) {
  return (1 / length(v)) * v;
}

Triple<double> any_across(const Triple<double>& v) {
  const bool along_x = std::abs(v.x) > 0.8;
  return unit(cross(v, along_x ? Triple<double>{0, 1, 0} : Triple<double>{1, 0, 0}));
}

/// Twice the area of a triangle in the plane, positive where it turns from x to y.
double twice_area(const Row& a, const Row& b, const Row& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

FacesInPlan::FacesInPlan(const mesh::Surface& surface, std::span<const Index> parts, const Triple<double>& up)
    : to_{any_across(up), cross(up, any_across(up)), up} {
  mesh::Surface flat;
  const auto position = [&](mesh::Index node) {
    const double* p = surface.positions.data() + 3 * static_cast<std::size_t>(node);
    return Triple<double>{p[0], p[1], p[2]};
  };
  for (mesh::Index node = 0; node < surface.node_count(); ++node) {
    nodes_.push_back(flattened(position(node)));
    flat.positions.insert(flat.positions.end(), {nodes_.back().x, nodes_.back().y, 0});
  }
  for (const Index part : parts)
    for (mesh::Index t = surface.parts[part].triangle_begin; t < surface.parts[part].triangle_end; ++t) {
      const auto& [a, b, c] = surface.triangles[t];
      flat.triangles.push_back({a, b, c});
      part_of_.push_back(part);
      slope_.push_back(
          std::abs(dot(unit(cross(position(b) - position(a), position(c) - position(a))), to_.up)));
    }
  if (flat.triangles.empty()) return;
  flat.parts = {{.triangle_end = static_cast<mesh::Index>(flat.triangles.size())}};
  flat_ = Boundary(flat, std::vector<Index>{0});
  grid_.build(flat_, 0);
}

Row FacesInPlan::flattened(const Triple<double>& point) const noexcept {
  return Row{{dot(point, to_.east), dot(point, to_.north), 0, dot(point, to_.up)}};
}

void FacesInPlan::on_line_through(const Triple<double>& point, std::vector<Face>& found) const {
  found.clear();
  if (flat_.empty()) return;
  const Row p = flattened(point);
  std::vector<Index> candidates;
  grid_.near(p, 0, candidates);
  for (const Index k : candidates) {
    const auto& corners = flat_.features()[k].nodes;
    const Row &a = nodes_[corners[0]], &b = nodes_[corners[1]], &c = nodes_[corners[2]];
    const double all = twice_area(a, b, c);
    const double wa = twice_area(p, b, c) / all, wb = twice_area(p, c, a) / all,
                 wc = twice_area(p, a, b) / all;
    if (!(wa >= 0 && wb >= 0 && wc >= 0)) continue;  // an upright face has no weights
    found.push_back({part_of_[k], wa * a.w + wb * b.w + wc * c.w - p.w, slope_[k]});
  }
}

}  // namespace talus::dem
