#pragma once

#include <numbers>

#include "dem_solver/solver.hpp"

/// Scenes of one or two spheres, as the closed forms speak of them.
namespace talus::dem::cases {

inline constexpr double g = 9.81;  // m/s^2

inline double ball_mass(double radius, double density) {
  return density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

struct SphereCase {
  double radius = 0.1;  ///< m
  double density = 2500;
  double youngs_modulus = 1e7;
  double poissons_ratio = 0.2;
  double restitution = 1;
  double friction = 0;
  double step = 1e-6;  ///< s

  double mass() const { return ball_mass(radius, density); }
  Material material() const {
    return {.name = "stone",
            .density = density,
            .youngs_modulus = youngs_modulus,
            .poissons_ratio = poissons_ratio};
  }
  SphereInput sphere(Triple<double> position, Triple<double> velocity, Triple<double> spin = {}) const {
    return {.position = position,
            .velocity = velocity,
            .spin = spin,
            .radius = radius,
            .mass = mass(),
            .material = 0};
  }
};

/// Partners of the sphere material 0: another sphere of it, and material 1, a rigid boundary.
inline ParticleModel model_of(const SphereCase& c, const Material& wall) {
  ParticleModel model;
  model.step = c.step;
  model.pairs = PairTable(2);
  for (const auto& [partner, index] : {std::pair{c.material(), 0}, std::pair{wall, 1}}) {
    PairParameters p = pair_parameters(HertzContact{c.restitution}, effective_moduli(c.material(), partner));
    set_friction(p, {.at_rest = c.friction, .sliding = c.friction});
    model.pairs.set(0, index, p);
  }
  if (c.friction > 0) model.law.friction = LawChoice::FrictionKind::constant;
  return model;
}

inline Material rigid() {
  return {.name = "rigid", .youngs_modulus = 1e20, .poissons_ratio = 0.25};
}

inline Plane floor() {
  return {.name = "floor", .point = {}, .normal = {0, 0, 1}, .material = 1};
}

inline Triple<double> position(const ParticleSolver& solver, Index id) {
  return triple<double>(solver.spheres().position[solver.place(id)]);
}
inline Triple<double> velocity(const ParticleSolver& solver, Index id) {
  return triple<double>(solver.spheres().velocity[solver.place(id)]);
}
inline Triple<double> spin(const ParticleSolver& solver, Index id) {
  return triple<double>(solver.spheres().spin[solver.place(id)]);
}
inline Triple<double> force(const ParticleSolver& solver, Index id) {
  return triple<double>(solver.spheres().force[solver.place(id)]);
}

/// Exact Hertz collision with R*, m*, E* and approach speed v (Johnson, Contact Mechanics, 1985,
/// section 11.4).
struct HertzCollision {
  double radius = 0, mass = 0, modulus = 0, speed = 0;  ///< R*, m*, E*, v

  double largest_overlap() const {
    return std::pow(15 * mass * speed * speed / (16 * modulus * std::sqrt(radius)), 0.4);
  }
  double largest_force() const {
    return 4.0 / 3 * modulus * std::sqrt(radius) * std::pow(largest_overlap(), 1.5);
  }
  /// t_c = 2 d_max/v times the integral of ds/sqrt(1 - s^(5/2)) from 0 to 1 = sqrt(pi)
  /// Gamma(7/5)/Gamma(9/10).
  double duration() const {
    return 2 * largest_overlap() / speed * std::sqrt(std::numbers::pi) * std::tgamma(1.4) / std::tgamma(0.9);
  }
};

}  // namespace talus::dem::cases
