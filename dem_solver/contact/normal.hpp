#pragma once

#include "dem_solver/contact/touch.hpp"

/// Normal laws. Each has energy, force and stiffness side by side.
namespace talus::dem {

/// The normal force law's contract: see Hertz. A law that remembers (memory_rows = 1: see Hysteretic) moves its memory on
/// in force(), and says in lost() what it has taken out of the motion since the contact began, J; the others are given no
/// memory. When the contact is seen from the partner x, y and z of the memory turn their signs, w does not.
template <class Law>
concept NormalLaw = requires(const Touch<double>& touch, const ContactParameters<double>& p,
                             Quad<double>* memory) {
  { Law::template force<double>(touch, p, memory) } -> std::same_as<NormalForce<double>>;
  { Law::template energy<double>(touch, p, memory) } -> std::same_as<double>;
}
&&(Law::memory_rows == 0 ||
   requires(const Touch<double>& touch, const ContactParameters<double>& p, const Quad<double>* memory) {
     { Law::template lost<double>(touch, p, memory) } -> std::same_as<double>;
   });

/// Hertz spring with the dashpot of constant restitution [Hertz 1882; Tsuji, Tanaka, Ishida, Powder Technol.
/// 71 (1992) 239, eq. 8-9 for the form of the dashpot; Thornton, Cummins, Cleary, Powder Technol. 233 (2013)
/// 30 for kt].
///
///     a = sqrt(R* d)     kn = 2 E* a     kt = 8 G* a
///     Fn = max(0, 2/3 kn d - 2 g sqrt(m* kn) vn)        energy = 0.4 (2/3 kn d) d        stiffness = kn
///
///     d  · overlap                         · m     · > 0 touching
///     vn · relative velocity along normal  · m/s   · > 0 separating
///     a  · contact radius                  · m     ·
///     E* · effective modulus               · Pa    · parameters.normal.x      1/E* = sum (1 - v^2)/E
///     G* · effective shear modulus         · Pa    · parameters.normal.y      1/G* = sum (2 - v)/G
///     g  · damping ratio                   · 1     · parameters.normal.z      from hertz_damping_ratio()
///     q  · sqrt(kt/kn)                     · 1     · parameters.normal.w      2 sqrt(G*/E*)
/// The dashpot along the surface, 2 g sqrt(m* kt), is q times the normal one.
/// Valid for a << R*, smooth spheres, no adhesion. Tests: verification/particles "hertz", unit "The normal
/// force is the derivative of its energy".
struct Hertz {
  static constexpr int memory_rows = 0;
  static constexpr bool spreads_over_area = false;

  template <class Real>
  TALUS_INLINE static NormalForce<Real> force(const Touch<Real>& touch, const ContactParameters<Real>& p,
                                              const Quad<Real>* = nullptr) noexcept {
    const Real zero{};
    const Real d = larger(touch.overlap, zero);
    const Real a = square_root(touch.reduced_radius * d);
    const Real kn = 2.0 * p.normal.x * a, kt = 8.0 * p.normal.y * a;
    const Real c = 2.0 * p.normal.z * square_root(touch.reduced_mass * kn);
    const Real elastic = (2.0 / 3.0) * kn * d;
    const Real total = larger(elastic - c * dot(touch.velocity, touch.normal), zero);
    return {elastic, d > zero ? total : zero, kn, c, kt, p.normal.w * c};
  }

  template <class Real>
  TALUS_INLINE static Real energy(const Touch<Real>& touch, const ContactParameters<Real>& p,
                                  const Quad<Real>* = nullptr) noexcept {
    const Real d = larger(touch.overlap, Real{});
    return (8.0 / 15.0) * p.normal.x * square_root(touch.reduced_radius * d) * d * d;
  }
};

/// Linear spring and dashpot [Cundall and Strack, Géotechnique 29 (1979) 47; restitution with the cut-off:
/// restitution.hpp].
///
///     Fn = max(0, k d - 2 z sqrt(m* k) vn)        energy = k d^2/2        stiffness = k        kt = ratio k
///
///     k  · stiffness             · N/m · parameters.normal.x
///     kt · tangential stiffness  · N/m · parameters.normal.y
///     z  · damping ratio         · 1   · parameters.normal.z      from oscillator_damping_ratio()
///     q  · sqrt(ratio)           · 1   · parameters.normal.w
/// Tests: "A collision on linear springs lasts as long as the oscillator and rebounds as asked for", unit
/// "The normal force is the derivative of its energy".
struct LinearSpring {
  static constexpr int memory_rows = 0;
  static constexpr bool spreads_over_area = false;

  template <class Real>
  TALUS_INLINE static NormalForce<Real> force(const Touch<Real>& touch, const ContactParameters<Real>& p,
                                              const Quad<Real>* = nullptr) noexcept {
    const Real zero{};
    const Real d = larger(touch.overlap, zero);
    const Real k = d > zero ? p.normal.x : zero, kt = d > zero ? p.normal.y : zero;
    const Real c = 2.0 * p.normal.z * square_root(touch.reduced_mass * k);
    const Real elastic = k * d;
    const Real total = larger(elastic - c * dot(touch.velocity, touch.normal), zero);
    return {elastic, total, k, c, kt, p.normal.w * c};
  }

  template <class Real>
  TALUS_INLINE static Real energy(const Touch<Real>& touch, const ContactParameters<Real>& p,
                                  const Quad<Real>* = nullptr) noexcept {
    const Real d = larger(touch.overlap, Real{});
    return 0.5 * p.normal.x * d * d;
  }
};

}  // namespace talus::dem
