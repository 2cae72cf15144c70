#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/verification/particles/particle_models.hpp"

/// A contact law each, and bodies of several balls that meet a plane under it.
namespace talus::dem::cases {

using Normal = LawChoice::Normal;

struct Law {
  Normal kind = Normal::hertz;
  double restitution = 0.5;
};

inline constexpr double modulus = 1e8;             // Pa, E* of Hertz's laws
inline constexpr double spring = 1e6;              // N/m, of the linear law
inline constexpr double foundation_modulus = 1e8;  // Pa/m

inline PairParameters parameters_of(const Law& law) {
  const EffectiveModuli moduli{modulus, modulus / 3};
  switch (law.kind) {
    case Normal::hertz:
      return pair_parameters(HertzContact{law.restitution}, moduli);
    case Normal::hysteretic_hertz:
      return pair_parameters(HystereticContact{law.restitution}, moduli);
    case Normal::linear:
      return pair_parameters(LinearContact{spring, 1, law.restitution});
    case Normal::foundation:
      break;
  }
  return pair_parameters(FoundationContact{foundation_modulus, 1, law.restitution});
}

inline const char* name_of(Normal kind) {
  switch (kind) {
    case Normal::hertz:
      return "hertz";
    case Normal::hysteretic_hertz:
      return "hysteretic";
    case Normal::linear:
      return "linear";
    case Normal::foundation:
      break;
  }
  return "foundation";
}

inline ParticleModel empty_model(const Law& law) {
  ParticleModel model;
  model.law.normal = law.kind;
  model.law.ledger = true;
  model.pairs = PairTable(2);
  model.pairs.set(0, 0, parameters_of(law));
  model.pairs.set(0, 1, parameters_of(law));
  return model;
}

/// Adds a rock of equal balls at places given from its centre.
struct Body {
  double mass = 100;
  Triple<double> moments{10, 10, 10};
  Triple<double> centre, velocity, spin;
  std::vector<Triple<double>> balls;
  double radius = 0.05, area = 0.01;
};
inline void add_body(ParticleModel& model, const Body& body) {
  const auto number = static_cast<Index>(model.rocks.size());
  model.rocks.push_back({.mass = body.mass,
                         .moments = body.moments,
                         .centre = body.centre,
                         .velocity = body.velocity,
                         .spin = body.spin,
                         .name = "body" + std::to_string(number)});
  for (const Triple<double>& ball : body.balls)
    model.spheres.push_back({.position = body.centre + ball,
                             .velocity = body.velocity + cross(body.spin, ball),
                             .spin = body.spin,
                             .radius = body.radius,
                             .mass = body.mass,
                             .material = 0,
                             .rock = number,
                             .area = body.area,
                             .facing = {}});
}

/// A square plate on n x n balls that comes down flat.
inline Body plate(int n, double speed) {
  Body body{.centre = {0, 0, 0.051}, .velocity = {0, 0, -speed}};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      body.balls.push_back({0.2 * (i - 0.5 * (n - 1)), 0.2 * (j - 0.5 * (n - 1)), 0});
  return body;
}

/// Runs until no sphere touches any more after one has. @return the largest force on the first rock along z, N
inline double until_free(ParticleSolver& solver) {
  double largest = 0;
  bool touched = false;
  for (int n = 0; n < 2'000'000; ++n) {
    solver.step();
    double stiffness = 0;
    for (const Row& force : solver.spheres().force) stiffness += force.w;
    largest = std::max(largest, solver.rocks().force(0).z);
    if (stiffness > 0) touched = true;
    if (touched && stiffness == 0) return largest;
  }
  FAIL("the body does not come free");
  return 0;
}

/// s; a small part of the period of the plate on all its balls. Linear dashpots begin at their full strength, so that the phase of
/// the first touch within a step counts.
inline double short_step(const Law& law, int balls, double mass) {
  const double stiffness = law.kind == Normal::linear       ? balls * spring
                           : law.kind == Normal::foundation ? balls * foundation_modulus * 0.01
                                                            : balls * 2 * modulus * std::sqrt(0.05 * 1e-3);
  const double stiffer = parameters_of(law).normal.z;
  const bool hysteretic = law.kind == Normal::foundation || law.kind == Normal::hysteretic_hertz;
  return 2 * std::numbers::pi * std::sqrt(mass / stiffness * (hysteretic ? stiffer : 1)) /
         (law.kind == Normal::linear ? 4000 : 1000);
}

}  // namespace talus::dem::cases
