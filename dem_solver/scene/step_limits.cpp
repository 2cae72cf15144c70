#include "dem_solver/scene/step_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

namespace talus::dem {

namespace {

constexpr double steps_in_contact = 30;
constexpr double rayleigh_fraction = 0.3;
constexpr double tunnelling_fraction = 0.5;

/// Keeps the smallest step and why.
struct Tightest {
  ParticleStepLimit limit;
  void consider(double seconds, const std::string& reason) {
    if (seconds >= limit.seconds) return;
    limit.seconds = seconds;
    limit.reason = reason;
  }
};

Tightest open_limit(const char* name, bool stability) {
  return {{.name = name,
           .seconds = std::numeric_limits<double>::infinity(),
           .stability = stability,
           .reason = {}}};
}

/// m; how far below a point the lowest plane or boundary node lies along gravity.
double drop_height(const ParticleModel& model, const Triple<double>& from) {
  const double g = length(model.gravity);
  if (g == 0) return 0;
  const Triple<double> down = (1 / g) * model.gravity;
  double drop = 0;
  for (Index node = 0; node < model.boundary.node_count(); ++node)
    drop = std::max(drop, dot(model.boundary.position(node) - from, down));
  for (const Plane& plane : model.planes) {
    const double fall = -dot(down, plane.normal);
    if (fall > 1e-3) drop = std::max(drop, dot(from - plane.point, plane.normal) / fall);
  }
  return drop;
}

/// A collision with a rigid partner at a speed: the tangent stiffness at the largest overlap, the duration
/// and the largest dashpot.
struct Collision {
  double stiffness = 0, duration = 0, dashpot = 0;
};

struct Impact {
  double radius = 0, mass = 0, speed = 0;  ///< R*, m*, approach
  double area = 0;                         ///< m^2; of the sphere's surface
};

Collision hertz_collision(const Impact& impact, const PairParameters& p) {
  const double modulus = p.normal.x;
  const double overlap = std::pow(
      15 * impact.mass * impact.speed * impact.speed / (16 * modulus * std::sqrt(impact.radius)), 0.4);
  const double stiffness = 2 * modulus * std::sqrt(impact.radius * overlap);
  const double duration =
      2.868 * std::pow(impact.mass * impact.mass / (impact.radius * modulus * modulus * impact.speed), 0.2);
  return {stiffness, duration, 2 * p.normal.z * std::sqrt(impact.mass * stiffness)};
}

Collision linear_collision(const Impact& impact, const PairParameters& p) {
  const double stiffness = p.normal.x;
  return {stiffness, std::numbers::pi * std::sqrt(impact.mass / stiffness),
          2 * p.normal.z * std::sqrt(impact.mass * stiffness)};
}

/// Loads in a quarter of a period, unloads in e times that; nothing but springs.
Collision foundation_collision(const Impact& impact, const PairParameters& p) {
  const double stiffness = p.normal.x * impact.area, e = std::sqrt(p.normal.z);
  return {stiffness / p.normal.z, std::numbers::pi / 2 * std::sqrt(impact.mass / stiffness) * (1 + e), 0};
}

Collision hysteretic_collision(const Impact& impact, const PairParameters& p) {
  const double e = std::sqrt(p.normal.z);
  PairParameters elastic = p;
  elastic.normal.z = 0;
  const Collision c = hertz_collision(impact, elastic);
  return {c.stiffness / p.normal.z, 0.5 * c.duration * (1 + e), 0};
}

Collision collision(LawChoice::Normal law, const Impact& impact, const PairParameters& p) {
  switch (law) {
    case LawChoice::Normal::linear:
      return linear_collision(impact, p);
    case LawChoice::Normal::hysteretic_hertz:
      return hysteretic_collision(impact, p);
    case LawChoice::Normal::foundation:
      return foundation_collision(impact, p);
    case LawChoice::Normal::hertz:
      break;
  }
  return hertz_collision(impact, p);
}

struct Limits {
  Tightest spring = open_limit("contact spring", true);
  Tightest node_spring = open_limit("contact spring on boundary nodes", true);
  Tightest tunnelling = open_limit("tunnelling", true);
  Tightest duration = open_limit("contact duration", false);
  Tightest face = open_limit("contacts of a rock", false);
  Tightest rayleigh = open_limit("Rayleigh wave", false);
  Tightest node_dashpot = open_limit(node_dashpot_limit, false);
};

class LimitSearch {
 public:
  LimitSearch(const ParticleModel& model, const LimitContext& context) : model_(model), context_(context) {
    const auto& masses = context.node_masses;
    lightest_node_ = masses.empty() ? 0 : *std::ranges::min_element(masses);
  }

  Limits run() {
    for (Index i = 0; i < static_cast<Index>(model_.spheres.size()); ++i) {
      const SphereInput& sphere = model_.spheres[i];
      const double speed = length(sphere.velocity) +
                           std::sqrt(2 * length(model_.gravity) * drop_height(model_, sphere.position));
      fastest_ = std::max(fastest_, speed);
      rayleigh(i, sphere);
      with_boundary(i, sphere, speed);
      if (speed > 0)
        for (const Plane& plane : model_.planes) contact(i, sphere, speed, plane.material);
    }
    with_spheres();
    if (model_.law.spreads_over_area()) rocks_on_faces();
    return limits_;
  }

 private:
  void rayleigh(Index i, const SphereInput& sphere) {
    if (model_.law.spreads_over_area()) return;  // of bodies that are elastic as spheres
    const Material& m = context_.materials[sphere.material];
    const double shear = m.youngs_modulus / (2 * (1 + m.poissons_ratio));
    const double crossing = std::numbers::pi * sphere.radius * std::sqrt(m.density / shear) /
                            (0.1630 * m.poissons_ratio + 0.8766);
    limits_.rayleigh.consider(rayleigh_fraction * crossing,
                              fmt::format("0.3 pi R sqrt(rho/G)/(0.163 v + 0.8766), sphere {}", i));
  }

  Collision contact(Index i, const SphereInput& sphere, double speed, Index partner) {
    const Impact impact{sphere.radius, sphere.mass, speed, sphere.area};
    if (model_.law.spreads_over_area() && sphere.area <= 0) return {};  // a ball deep inside of a rock
    const Collision c = collision(model_.law.normal, impact, model_.pairs(sphere.material, partner));
    const std::string entity = fmt::format("sphere {} of {:.4g} kg at {:.4g} m/s", i, sphere.mass, speed);
    limits_.spring.consider(2 * std::sqrt(sphere.mass / c.stiffness), "2 sqrt(m/k), " + entity);
    limits_.duration.consider(c.duration / steps_in_contact,
                              fmt::format("t_c/30, t_c {:.4g} s, {}", c.duration, entity));
    return c;
  }

  void with_boundary(Index i, const SphereInput& sphere, double speed) {
    if (model_.boundary.empty() || speed <= 0) return;
    // Features of one part share material and radius: the first of each speaks for all.
    Index part = -1;
    for (const Feature& feature : model_.boundary.features()) {
      if (feature.part == part) continue;
      part = feature.part;
      const Collision c = contact(i, sphere, speed, feature.material);
      limits_.tunnelling.consider(tunnelling_fraction * (sphere.radius + feature.wire_radius) / speed,
                                  fmt::format("(R + r_w)/(2 v), sphere {} at {:.4g} m/s", i, speed));
      if (lightest_node_ <= 0) continue;
      const std::string entity = fmt::format("sphere {} of {:.4g} kg at {:.4g} m/s on a node of {:.4g} kg", i,
                                             sphere.mass, speed, lightest_node_);
      limits_.node_spring.consider(2 * std::sqrt(lightest_node_ / c.stiffness), "2 sqrt(m/k), " + entity);
      if (c.dashpot > 0 && !model_.implicit_contact)
        limits_.node_dashpot.consider(2 * lightest_node_ / c.dashpot, "2 m/c, " + entity);
    }
  }

  /// Rocks with a quarter of their surface in contact.
  void rocks_on_faces() {
    std::vector<double> stiffest(model_.rocks.size());
    for (const SphereInput& sphere : model_.spheres)
      for (Index partner = 0; sphere.rock >= 0 && partner < model_.pairs.materials(); ++partner)
        if (const PairParameters& p = model_.pairs(sphere.material, partner); p.normal.x > 0)
          stiffest[sphere.rock] = std::max(stiffest[sphere.rock], p.normal.x / p.normal.z);
    std::vector<double> area(model_.rocks.size());
    for (const SphereInput& sphere : model_.spheres)
      if (sphere.rock >= 0) area[sphere.rock] += sphere.area;
    for (std::size_t k = 0; k < area.size(); ++k)
      if (const double stiffness = 0.25 * stiffest[k] * area[k]; stiffness > 0)
        limits_.face.consider(
            2 * std::sqrt(model_.rocks[k].mass / stiffness),
            fmt::format("2 sqrt(m e^2/(k A)), rock {} on {:.3g} m^2, a quarter of its surface",
                        model_.rocks[k].name, 0.25 * area[k]));
  }

  /// The lightest sphere of each material against every other material, at twice the largest speed.
  void with_spheres() {
    if (model_.spheres.size() < 2 || fastest_ <= 0) return;
    std::vector<Index> lightest(static_cast<std::size_t>(model_.pairs.materials()), -1);
    for (Index i = 0; i < static_cast<Index>(model_.spheres.size()); ++i) {
      Index& best = lightest[model_.spheres[i].material];
      if (best < 0 || model_.spheres[i].mass < model_.spheres[best].mass) best = i;
    }
    for (Index i : lightest)
      for (Index j : lightest)
        if (i >= 0 && j >= 0 &&
            model_.pairs(model_.spheres[i].material, model_.spheres[j].material).normal.x > 0)
          contact(i, model_.spheres[i], 2 * fastest_, model_.spheres[j].material);
  }

  const ParticleModel& model_;
  const LimitContext& context_;
  double lightest_node_ = 0;
  double fastest_ = 0;
  Limits limits_;
};

}  // namespace

std::vector<ParticleStepLimit> step_limits(const ParticleModel& model, const LimitContext& context) {
  const Limits found = LimitSearch(model, context).run();
  std::vector<ParticleStepLimit> limits;
  for (const Tightest& tightest : {found.spring, found.node_spring, found.tunnelling, found.duration,
                                   found.face, found.rayleigh, found.node_dashpot})
    if (std::isfinite(tightest.limit.seconds)) limits.push_back(tightest.limit);
  return limits;
}

}  // namespace talus::dem
