#include "dem_solver/scene/start_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/errors.hpp"
#include "core/units/units.hpp"
#include "dem_solver/scene/body_names.hpp"
#include "dem_solver/scene/faces_in_plan.hpp"

namespace talus::dem {

namespace {

constexpr double touching = 0.02, deepest_rest = 0.1;  // of the radius

/// What the spheres of one body or stream do to one partner.
struct Finding {
  std::int64_t spheres = 0;
  Index latest = -1;   ///< the last one counted
  double depth = 0;    ///< m; the largest
  double allowed = 0;  ///< m
  Triple<double> centre;
  bool below = false;  ///< of the deepest: below faces, not merely through one
  bool in_stream = false, in_rock = false;
};

class StartCheck {
 public:
  StartCheck(const ParticlesScene& particles, const ParticleModel& model, const mesh::Surface& surface)
      : particles_(particles), model_(model), surface_(surface), names_(particles, model.spheres) {
    for (const SphereInput& sphere : model_.spheres)
      if (sphere.rock >= 0)
        largest_of_rock_[sphere.rock] = std::max(largest_of_rock_[sphere.rock], sphere.radius);
  }

  void run() {
    meet_planes();
    if (!model_.boundary.empty()) {
      meet_features();
      look_for_height_grids();
      look_for_ground();
    }
    report();
  }

 private:
  double radius_of_body(const SphereInput& sphere) const {
    return sphere.rock >= 0 ? largest_of_rock_.at(sphere.rock) : sphere.radius;
  }
  /// m; under its weight.
  double rest_depth(double weight, double stiffness, double radius, double area) const {
    switch (model_.law.normal) {
      case LawChoice::Normal::linear:
        return weight / stiffness;
      case LawChoice::Normal::foundation:
        return area > 0 ? weight / (stiffness * area) : 0;
      case LawChoice::Normal::hertz:
      case LawChoice::Normal::hysteretic_hertz:
        break;
    }
    return std::pow(0.75 * weight / (stiffness * std::sqrt(radius)), 2.0 / 3);
  }
  double allowed_depth(const SphereInput& sphere, Index partner_material) const {
    const double radius = radius_of_body(sphere), weight = sphere.mass * length(model_.gravity);
    const double stiffness = model_.pairs(sphere.material, partner_material).normal.x;  // E*, k or k_A
    const double rest = rest_depth(weight, stiffness, radius, sphere.area);
    return std::max(touching * radius, std::min(deepest_rest * radius, rest));
  }

  void note(Index k, const std::string& partner, double depth, double allowed, bool below = false) {
    if (depth <= allowed) return;
    Finding& finding = findings_[{names_.key(k), partner}];
    if (finding.latest != k) ++finding.spheres;
    finding.latest = k;
    if (depth <= finding.depth) return;
    finding.depth = depth;
    finding.allowed = allowed;
    finding.centre = model_.spheres[k].position;
    finding.below = below;
    finding.in_stream = names_.in_stream(k);
    finding.in_rock = model_.spheres[k].rock >= 0;
  }

  template <class Visit>
  void for_spheres(Visit&& visit) const {
    for (std::size_t k = 0; k < model_.spheres.size(); ++k) visit(static_cast<Index>(k), model_.spheres[k]);
  }

  void meet_planes() {
    for_spheres([&](Index k, const SphereInput& sphere) {
      for (const Plane& plane : model_.planes)
        note(k, fmt::format("plane `{}`", plane.name),
             sphere.radius - height_above(plane, row(sphere.position)),
             allowed_depth(sphere, plane.material));
    });
  }

  std::string part_name(const char* what, Index part) const {
    return fmt::format("{} of `{}`", what, surface_.parts[part].name);
  }

  void meet_features() {
    FeatureGrid grid;
    grid.build(model_.boundary, 0);
    std::vector<Index> near;
    for_spheres([&](Index k, const SphereInput& sphere) {
      grid.near(row(sphere.position), sphere.radius, near);
      for (const Index f : near) {
        const Feature& feature = model_.boundary.features()[f];
        const auto closest = model_.boundary.closest(feature, sphere.position);
        const double distance = length(sphere.position - closest.point) - feature.wire_radius;
        note(k, part_name(feature.is_segment() ? "a wire" : "a face", feature.part), sphere.radius - distance,
             allowed_depth(sphere, feature.material));
      }
    });
  }

  /// The boundaries of the scene's own whose shape is as asked for; they stand before those of the structure.
  template <class Wanted>
  std::vector<Index> own_parts(Wanted&& wanted) const {
    std::vector<Index> parts;
    for (std::size_t k = 0; k < surface_.parts.size(); ++k) {
      const auto own = std::ranges::find(particles_.boundaries, surface_.parts[k].name,
                                         [](const auto& boundary) { return boundary.first; });
      if (own == particles_.boundaries.end()) break;
      if (wanted(own->second)) parts.push_back(static_cast<Index>(k));
    }
    return parts;
  }

  void look_for_height_grids() {
    const auto grids = own_parts([](const BoundaryScene& b) {
      return std::holds_alternative<HeightGridScene>(b.shape) && !b.velocity;
    });
    if (grids.empty()) return;
    const FacesInPlan faces(surface_, grids, {0, 0, 1});
    std::vector<FacesInPlan::Face> found;
    for_spheres([&](Index k, const SphereInput& sphere) {
      faces.on_line_through(sphere.position, found);
      for (const auto& face : found)
        if (face.height > 0) note_below(k, face);
    });
  }

  void look_for_ground() {
    const double gravity = length(model_.gravity);
    const auto at_rest = own_parts([](const BoundaryScene& b) { return !b.velocity; });
    if (gravity == 0 || at_rest.empty()) return;
    std::vector<Index> all(surface_.parts.size());
    std::iota(all.begin(), all.end(), 0);
    const Triple<double> up = (-1 / gravity) * model_.gravity;
    const FacesInPlan faces(surface_, all, up);
    std::map<std::string, std::vector<std::pair<Index, FacesInPlan::Face>>> lost;  // of each body
    std::map<std::string, std::size_t> spheres;
    std::vector<FacesInPlan::Face> found;
    for_spheres([&](Index k, const SphereInput& sphere) {
      ++spheres[names_.key(k)];
      if (dot(sphere.velocity, up) > 0 || above_a_plane(sphere, up)) return;
      faces.on_line_through(sphere.position, found);
      if (std::ranges::any_of(found, [](const auto& face) { return face.height <= 0; })) return;
      constexpr double flat = 0.5;  // 60 degrees
      const auto roof = std::ranges::find_if(found, [&](const auto& face) {
        return face.slope > flat && std::ranges::find(at_rest, face.part) != at_rest.end();
      });
      if (roof != found.end()) lost[names_.key(k)].emplace_back(k, *roof);
    });
    // Some spheres of a stream may start above the outlet of a silo with a roof; a body is lost as a whole.
    for (const auto& [key, below] : lost)
      if (below.size() == spheres[key])
        for (const auto& [k, face] : below) note_below(k, face);
  }
  bool above_a_plane(const SphereInput& sphere, const Triple<double>& up) const {
    return std::ranges::any_of(model_.planes, [&](const Plane& plane) {
      return dot(plane.normal, up) > 0 && height_above(plane, row(sphere.position)) > 0;
    });
  }
  void note_below(Index k, const FacesInPlan::Face& face) {
    note(k, part_name("a face", face.part), model_.spheres[k].radius + face.height, 0, true);
  }

  static std::string sentence(const std::string& partner, const Finding& f) {
    const std::string depth = core::readable(f.depth, "m");
    const std::string where =
        fmt::format("{} at ({:.6g}, {:.6g}, {:.6g}) m", f.in_rock ? "its sphere" : "with the centre",
                    f.centre.x, f.centre.y, f.centre.z);
    const std::string who = f.in_stream ? fmt::format("{} of its spheres start", f.spheres) : "starts";
    const std::string deepest = f.in_stream ? "the deepest by " : "by ";
    if (f.below)
      return fmt::format("{} below {}, {}{}, {}; nothing would hold it there: move it above", who, partner,
                         deepest, depth, where);
    return fmt::format("{} inside of {}, {}{}, {}; more than {} would throw it out", who, partner, deepest,
                       depth, where, core::readable(f.allowed, "m"));
  }

  void report() const {
    std::vector<core::Complaint> complaints;
    for (const auto& [names, finding] : findings_)
      complaints.push_back({.key_path = names.first, .message = sentence(names.second, finding)});
    if (!complaints.empty()) throw core::ConfigError(std::move(complaints));
  }

  const ParticlesScene& particles_;
  const ParticleModel& model_;
  const mesh::Surface& surface_;
  BodyNames names_;
  std::map<Index, double> largest_of_rock_;                          ///< m; radius of a rock's largest sphere
  std::map<std::pair<std::string, std::string>, Finding> findings_;  ///< of a body's key and a partner
};

}  // namespace

void check_start(const ParticlesScene& particles, const ParticleModel& model, const mesh::Surface& surface) {
  StartCheck(particles, model, surface).run();
}

}  // namespace talus::dem
