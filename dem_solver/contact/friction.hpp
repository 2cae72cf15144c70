#pragma once

#include "dem_solver/contact/touch.hpp"

/// Friction: a tangential spring with history and a dashpot in parallel, limited by Coulomb's law.
namespace talus::dem {

/// One coefficient, whatever the sliding speed. parameters.friction.x = mu.
struct ConstantCoefficient {
  template <class Real>
  TALUS_INLINE static Real coefficient(const Triple<Real>&, const ContactParameters<Real>& p) noexcept {
    return p.friction.x;
  }
};

/// mu = mu_d + (mu_s - mu_d) exp(-|vt| / v_decay). parameters.friction = mu_s, mu_d, 1/v_decay (s/m).
struct FallingCoefficient {
  template <class Real>
  TALUS_INLINE static Real coefficient(const Triple<Real>& sliding,
                                       const ContactParameters<Real>& p) noexcept {
    const Real speed = square_root(dot(sliding, sliding));
    return p.friction.y + (p.friction.x - p.friction.y) * exponential(-speed * p.friction.z);
  }
};

/// Incremental tangential spring [Mindlin and Deresiewicz 1953 in the no-slip stiffness of Thornton, Cummins,
/// Cleary 2013, section 3].
///
///     turn:     Fe <- (Fe - (Fe.n) n), length kept             the spring follows the contact plane
///     unload:   Fe <- Fe kt/kt_old  where kt < kt_old          so that unloading gives no energy; loading
///                                                              leaves Fe
///     stretch:  Fe <- Fe - kt vt step                          cut to the length mu Fn
///     Ft = (Fe before it is cut) - ct vt                       cut to the length mu Fn
///     energy = Fe^2/(2 kt)
///
///     Fe     · spring force on the first sphere   · N    · memory x y z
///     kt_old · its stiffness at the last step     · N/m  · memory w
///     vt     · sliding velocity at the contact    · m/s  · of the first over the partner
///     ct     · dashpot, 2 g sqrt(m* kt)           · N s/m
/// The spring never holds more than its own stretch has put into it: where only spring and dashpot together
/// reach Coulomb's limit, the force is cut and the spring is not loaded in its place.
/// Tests: verification/particles "friction", unit "A tangential spring under a tenth of its load returns what
/// its softened stiffness holds, and no more".
template <class Coefficient>
struct CoulombFriction {
  static constexpr int memory_rows = 1;

  /// The spring of the last step, turned and unloaded, before it is stretched.
  template <class Real>
  TALUS_INLINE static Triple<Real> spring_at_start(const Triple<Real>& n, Real kt,
                                                   const Quad<Real>& memory) noexcept {
    const Real tiny = Real{} + 1e-300;
    const Triple<Real> old = triple(memory);
    const Triple<Real> turned = old - dot(old, n) * n;
    // Length kept and unloaded, in one square root and one division.
    const Real kept = smaller(kt, memory.w), stiffness = memory.w;
    return square_root(dot(old, old) * (kept * kept) /
                       larger(dot(turned, turned) * (stiffness * stiffness), tiny)) *
           turned;
  }

  /// The vector, cut to a length where it is longer. Most contacts stick: they are spared the root and the
  /// division.
  template <class Real>
  TALUS_INLINE static Triple<Real> shortened(const Triple<Real>& vector, Real most) noexcept {
    const Real none{}, tiny = none + 1e-300;
    const Real squared = dot(vector, vector);
    const auto longer = squared > most * most;
    if (!any(longer)) return vector;
    return select(longer, (most / larger(square_root(squared), tiny)) * vector, vector);
  }

  template <class Real>
  TALUS_INLINE static Real limit(const Triple<Real>& sliding, Real normal_force,
                                 const ContactParameters<Real>& p) noexcept {
    return Coefficient::coefficient(sliding, p) * normal_force;
  }

  template <class Real>
  TALUS_INLINE static Triple<Real> force(const Touch<Real>& touch, const NormalForce<Real>& normal,
                                         const ContactParameters<Real>& p, double step,
                                         Quad<Real>& memory) noexcept {
    const Real kt = normal.tangential_stiffness;
    const Triple<Real> vt = touch.velocity - dot(touch.velocity, touch.normal) * touch.normal;
    const Triple<Real> spring = spring_at_start(touch.normal, kt, memory) - (kt * step) * vt;
    const Triple<Real> wanted = spring - normal.tangential_damping * vt;
    const Real most = limit(vt, normal.total, p);
    memory = quad(shortened(spring, most), kt);
    return shortened(wanted, most);
  }

  /// J; of the spring as it was left in the memory.
  template <class Real>
  TALUS_INLINE static Real energy(const Quad<Real>& memory) noexcept {
    const Real none{}, tiny = none + 1e-300;
    return memory.w > none ? dot(triple(memory), triple(memory)) / (2.0 * larger(memory.w, tiny)) : none;
  }
};

using Friction = CoulombFriction<ConstantCoefficient>;
using FallingFriction = CoulombFriction<FallingCoefficient>;

}  // namespace talus::dem
