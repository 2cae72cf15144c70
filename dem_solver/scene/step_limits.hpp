#pragma once

#include <span>
#include <string>
#include <vector>

#include "dem_solver/solver.hpp"

/// Largest steps of the particle side, as `talus check` lists them.
namespace talus::dem {

struct ParticleStepLimit {
  std::string name;
  double seconds = 0;     ///< largest step that keeps it
  bool stability = true;  ///< false: a larger step costs accuracy only
  std::string reason;     ///< formula and entity
};

/// The limit that implicit contact lifts.
inline constexpr const char* node_dashpot_limit = "contact dashpot on boundary nodes";

/// What the limits need beside the model.
struct LimitContext {
  std::span<const Material> materials;
  std::span<const double> node_masses;  ///< kg; behind the moving nodes of the boundary; empty: it is rigid
};

/// Limits before time 0, from the model's state. Impact speeds are estimated as the initial speed plus that
/// of the free fall to the lowest point of the planes and the boundary, overlaps as those of a Hertz (or
/// linear) collision at that speed with a rigid partner.
///
/// Stability: beyond them the motion gains energy or passes through walls.
///     contact spring       2 sqrt(m/k)        leapfrog on the tangent stiffness k at the largest overlap
///     spring on nodes      2 sqrt(m_n/k)      the same spring moves a boundary node of mass m_n
///     tunnelling           (R + r_w)/(2 v)    a centre must not reach the other side of a wire in a step
/// Accuracy: beyond them results drift from the converged ones, bounded because a contact never pulls.
///     contact duration     t_c/30             restitution within 1 %
///     Rayleigh             0.3 pi R sqrt(rho/G)/(0.1630 v + 0.8766)
///                                             a surface wave must not cross a sphere in a step
///     dashpot on nodes     2 m_n/c            the dashpot sized by the rock's mass would reverse a light
///                                             node's velocity in a step
/// Tests: tests/coupled/step_limits_test.py takes each to 0.95 and to 1.1.
std::vector<ParticleStepLimit> step_limits(const ParticleModel& model, const LimitContext& context);

}  // namespace talus::dem
