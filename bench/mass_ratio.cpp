// What a light structure costs each coupling scheme: a sphere of 100 kg falls with 8 m/s on one degree of
// freedom (1e5 N/m, contact 5e6 N/m, no damping) whose mass is the sphere's divided by the mass ratio. For
// each scheme the window is halved until the peak deflection is within 2 % of the undivided system at a fine
// step and the energy after the impact within 5 % of that before, there and with half that window; the line
// tells this window and what it cost in solver calls until the sphere left. One JSON object a line; the table
// of docs/coupling.md.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/errors.hpp"
#include "coupler/acceleration/iqn_ils.hpp"
#include "coupler/acceleration/relaxation.hpp"
#include "coupler/schemes/implicit.hpp"
#include "coupler/schemes/serial_explicit.hpp"
#include "tests/support/coupled_pair.hpp"
#include "tests/support/sphere_on_spring.hpp"

using namespace talus;

namespace {

constexpr double peak_tolerance = 0.02, energy_tolerance = 0.05;
constexpr double longest_window = 2e-2, shortest_window = 1e-6;  // s

struct Outcome {
  double peak = 0, energy = 0;  ///< relative errors
  std::int64_t calls = 0;
  bool good() const { return peak <= peak_tolerance && energy <= energy_tolerance; }
};

template <class Scheme>
std::int64_t calls_of(const Scheme& scheme, std::int64_t windows) {
  if constexpr (requires { scheme.tally(); }) return 2 * scheme.tally().iterations;
  return 2 * windows;
}

template <class MakeScheme>
Outcome impact(const test::SphereOnSpring& system, const test::Undivided& reference, double length,
               MakeScheme&& make_scheme) {
  test::SphereState sphere;
  test::CoupledPair pair([&](auto& p) { test::serve_structure(p, system); },
                         [&](auto& p) { test::serve_sphere(p, system, sphere); }, {length});
  auto scheme = make_scheme(pair.exchange());
  double peak = 0;
  std::int64_t n = 0;
  for (; static_cast<double>(n) * length < reference.contact; ++n) {
    scheme.compute(pair.exchange(), {.index = n, .unit = length});
    peak = std::max(peak, -pair.displacement());
  }
  const test::TrapezoidalMass node{.mass = system.structure_mass,
                                   .stiffness = system.structure_stiffness,
                                   .u = pair.displacement(),
                                   .v = pair.velocity()};
  const double overlap = std::max(0.0, node.u - sphere.position);
  const double before = 0.5 * system.sphere_mass * system.sphere_velocity * system.sphere_velocity;
  const double after = 0.5 * system.sphere_mass * sphere.velocity * sphere.velocity + node.energy() +
                       0.5 * system.contact_stiffness * overlap * overlap;
  return {.peak = std::abs(peak / reference.peak - 1),
          .energy = std::abs(after / before - 1),
          .calls = calls_of(scheme, n)};
}

/// Nothing where the iteration does not converge in so long a window.
template <class MakeScheme>
std::optional<Outcome> try_window(const test::SphereOnSpring& system, const test::Undivided& reference,
                                  double length, MakeScheme&& make_scheme) {
  try {
    return impact(system, reference, length, make_scheme);
  } catch (const core::NumericalError&) {
    return std::nullopt;
  }
}

template <class MakeScheme>
void measure(const char* name, double mass_ratio, MakeScheme&& make_scheme) {
  const test::SphereOnSpring system{.structure_mass = 100 / mass_ratio};
  const auto reference = test::undivided(system, 2e-7);
  std::optional<Outcome> longer;
  for (double length = longest_window; length > shortest_window; length /= 2) {
    const auto outcome = try_window(system, reference, length, make_scheme);
    if (outcome && outcome->good() && longer && longer->good()) {
      fmt::print(
          "{{\"mass_ratio\":{},\"scheme\":\"{}\",\"window_us\":{:.1f},\"solver_calls\":{},"
          "\"peak_error\":{:.4f},\"energy_error\":{:.4f}}}\n",
          mass_ratio, name, 2e6 * length, longer->calls, longer->peak, longer->energy);
      return;
    }
    longer = outcome;
  }
  fmt::print("{{\"mass_ratio\":{},\"scheme\":\"{}\",\"window_us\":null}}\n", mass_ratio, name);
}

template <class Acceleration>
auto strong(Acceleration acceleration) {
  constexpr coupler::Convergence convergence{
      .relative = 1e-4, .absolute = {1e-9, 1e-6, 1e-3}, .most_iterations = 100};
  return [=](coupler::Exchange& exchange) {
    return coupler::Implicit(coupler::MotionUnknown(exchange), acceleration, convergence,
                             coupler::Predictor::linear);
  };
}

}  // namespace

int main() {
  for (const double mass_ratio : {1.0, 10.0, 100.0, 1000.0}) {
    measure("weak", mass_ratio, [](coupler::Exchange&) { return coupler::SerialExplicit{}; });
    measure("plain", mass_ratio, strong(coupler::NoAcceleration{}));
    measure("fixed", mass_ratio, strong(coupler::FixedRelaxation{0.1}));
    measure("aitken", mass_ratio, strong(coupler::Aitken(0.1)));
    measure("iqn_ils", mass_ratio, strong(coupler::IqnIls({.initial_factor = 0.1})));
  }
}
