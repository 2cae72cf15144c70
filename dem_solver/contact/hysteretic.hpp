#pragma once

#include "dem_solver/contact/touch.hpp"

/// Normal laws that lose energy by the way they unload, without a dashpot.
namespace talus::dem {

/// The loading curve of a sphere: Hertz. parameters.normal = E*, G*, e^2.
///     F = 4/3 E* sqrt(R* d) d        work done = 2/5 F d        kt = 8 G* sqrt(R* d)
struct SphereLoading {
  static constexpr bool spreads_over_area = false;
  static constexpr double work_share = 0.4;  ///< of F d
  static constexpr double power = 1.5;       ///< of d in F

  template <class Real>
  TALUS_INLINE static Real force(const Touch<Real>& touch, const ContactParameters<Real>& p,
                                 Real d) noexcept {
    return (4.0 / 3) * p.normal.x * square_root(touch.reduced_radius * d) * d;
  }
  template <class Real>
  TALUS_INLINE static Real tangential(const Touch<Real>& touch, const ContactParameters<Real>& p,
                                      Real d) noexcept {
    return 8.0 * p.normal.y * square_root(touch.reduced_radius * d);
  }
  /// x^power and, without its factor, the derivative.
  template <class Real>
  TALUS_INLINE static Real shape(Real x) noexcept {
    return x * square_root(x);
  }
  template <class Real>
  TALUS_INLINE static Real slope(Real x) noexcept {
    return square_root(x);
  }
};

/// The loading curve of an elastic foundation [Johnson, Contact Mechanics, 1985, section 4.3]: each sphere of a rock
/// carries the share of the surface that is nearest to it, so that the sum does not depend on how finely the rock is
/// filled. parameters.normal = stiffness of an area (Pa/m), its tangential one, e^2.
///     F = k_A A d        work done = 1/2 F d        kt = ratio k_A A
struct FoundationLoading {
  static constexpr bool spreads_over_area = true;
  static constexpr double work_share = 0.5;
  static constexpr double power = 1;

  template <class Real>
  TALUS_INLINE static Real force(const Touch<Real>& touch, const ContactParameters<Real>& p,
                                 Real d) noexcept {
    return p.normal.x * touch.area * d;
  }
  template <class Real>
  TALUS_INLINE static Real tangential(const Touch<Real>& touch, const ContactParameters<Real>& p,
                                      Real d) noexcept {
    return d > Real{} ? p.normal.y * touch.area : Real{};
  }
  template <class Real>
  TALUS_INLINE static Real shape(Real x) noexcept {
    return x;
  }
  template <class Real>
  TALUS_INLINE static Real slope(Real) noexcept {
    return Real{} + 1.0;
  }
};

/// Loads along a curve and unloads, down to an indentation that stays while the contact lasts, along one that gives
/// back the part e^2 of the work [Walton and Braun, J. Rheol. 30 (1986) 949, there for straight lines].
///
///     loading    d = dm:   F = F(dm)
///     below dm:            F = F(dm) x^p        x = (d - d0)/(dm - d0), not below 0        d0 = (1 - e^2) dm
///     energy = s F (d - d0)        lost = (1 - e^2) s F(dm) dm
///
///     d    · overlap                                · m   ·
///     dm   · the largest so far                     · m   · memory w; back to 0 when the contact ends
///     A    · area, of a foundation                  · m^2 · size of memory x; that of the first touch
///     e    · restitution                            · 1   · e^2 = parameters.normal.z
///     p, s · power of F, share of F d that is work  · 1   · of the loading curve
///
/// With the same power the unloading curve through (dm, F) holds e^2 of the work when it ends at d0. The energy that comes back
/// is e^2 of what went in for any number of contacts of a body at once, whatever their places; nothing acts on light
/// nodes but springs. The price: below dm nothing is lost, so bodies that have come to rest go on trembling at what their
/// weight presses. Unloading is 1/e^2 stiffer, and so is what a step must resolve. Tests: unit "A hysteretic contact
/// ...", verification/particles "rocks of many contacts".
template <class Loading>
struct Hysteretic {
  static constexpr int memory_rows = 1;
  static constexpr bool spreads_over_area = Loading::spreads_over_area;

  template <class Real>
  TALUS_INLINE static NormalForce<Real> force(const Touch<Real>& touch, const ContactParameters<Real>& p,
                                              Quad<Real>* memory) noexcept {
    const Real zero{};
    const Real d = larger(touch.overlap, zero);
    if constexpr (spreads_over_area) memory->x = memory->w > zero ? memory->x : touch.area;
    memory->w = d > zero ? larger(memory->w, d) : zero;
    const Unloading<Real> at = unloading(touch, p, *memory);
    const Real f = at.largest * Loading::shape(at.x);
    const Real stiffness =
        (Loading::power * at.largest * Loading::slope(at.x)) / larger(at.range, zero + 1e-300);
    return {f, f, d > zero ? stiffness : zero, zero, Loading::tangential(begun(touch, *memory), p, d), zero};
  }

  template <class Real>
  TALUS_INLINE static Real energy(const Touch<Real>& touch, const ContactParameters<Real>& p,
                                  const Quad<Real>* memory) noexcept {
    const Unloading<Real> at = unloading(touch, p, *memory);
    return Loading::work_share * at.largest * Loading::shape(at.x) * at.x * at.range;
  }

  /// J; since the contact began.
  template <class Real>
  TALUS_INLINE static Real lost(const Touch<Real>& touch, const ContactParameters<Real>& p,
                                const Quad<Real>* memory) noexcept {
    return Loading::work_share * (1.0 - p.normal.z) * Loading::force(begun(touch, *memory), p, memory->w) *
           memory->w;
  }

 private:
  /// With the area that the contact began with, so that turning while it lasts takes and gives no energy.
  template <class Real>
  TALUS_INLINE static Touch<Real> begun(Touch<Real> touch, const Quad<Real>& memory) noexcept {
    if constexpr (spreads_over_area) touch.area = larger(memory.x, -memory.x);
    return touch;
  }

  template <class Real>
  struct Unloading {
    Real largest;  ///< N; the force at dm
    Real range;    ///< m; dm - d0
    Real x;        ///< where the contact is between d0 and dm, from 0 to 1
  };
  template <class Real>
  TALUS_INLINE static Unloading<Real> unloading(const Touch<Real>& touch, const ContactParameters<Real>& p,
                                                const Quad<Real>& memory) noexcept {
    const Real zero{}, tiny = zero + 1e-300;
    const Real range = p.normal.z * memory.w;
    const Real above = larger(larger(touch.overlap, zero) - (memory.w - range), zero);
    return {Loading::force(begun(touch, memory), p, memory.w), range, above / larger(range, tiny)};
  }
};

using HystereticHertz = Hysteretic<SphereLoading>;
using Foundation = Hysteretic<FoundationLoading>;

}  // namespace talus::dem
