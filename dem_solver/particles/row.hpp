#pragma once

#include <cmath>
#include <cstdint>

/// The small algebra of the particle solver. One formula serves one contact (Real = double) and four at a
/// time (Real = Lanes), so that the vectorised loop and the scalar one cannot drift apart.
namespace talus::dem {

using Index = std::int32_t;

/// Four doubles that are computed on together. The width is the same on every machine, and so are the bits.
using Lanes = double __attribute__((vector_size(32)));
inline constexpr int lane_count = 4;

#define TALUS_INLINE [[gnu::always_inline]] inline

/// Three components and a fourth that travels with them (a radius, a mass, a stiffness; said where it is
/// used).
template <class Real>
struct Quad {
  Real x{}, y{}, z{}, w{};
};

/// A row of the particle arrays: one cache line holds two of them, and four load as lanes with a
/// transposition.
struct alignas(32) Row : Quad<double> {};
static_assert(sizeof(Row) == 32);

template <class Real>
struct Triple {
  Real x{}, y{}, z{};
};

TALUS_INLINE double square_root(double a) noexcept {
  return std::sqrt(a);
}
TALUS_INLINE Lanes square_root(Lanes a) noexcept {
#ifdef __AVX__
  return __builtin_ia32_sqrtpd256(a);
#else
  return Lanes{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
#endif
}
TALUS_INLINE double exponential(double a) noexcept {
  return std::exp(a);
}
TALUS_INLINE Lanes exponential(Lanes a) noexcept {
  return Lanes{std::exp(a[0]), std::exp(a[1]), std::exp(a[2]), std::exp(a[3])};
}
/// Whether a comparison holds, of any lane.
TALUS_INLINE bool any(bool condition) noexcept {
  return condition;
}
TALUS_INLINE bool any(decltype(Lanes{} > Lanes{}) condition) noexcept {
#ifdef __AVX__
  return __builtin_ia32_movmskpd256(reinterpret_cast<Lanes>(condition)) != 0;
#else
  return (condition[0] | condition[1] | condition[2] | condition[3]) != 0;
#endif
}
template <class Real>
TALUS_INLINE Real larger(Real a, Real b) noexcept {
  return a > b ? a : b;
}
template <class Real>
TALUS_INLINE Real smaller(Real a, Real b) noexcept {
  return a < b ? a : b;
}

template <class Real>
TALUS_INLINE Triple<Real> operator+(const Triple<Real>& a, const Triple<Real>& b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
TALUS_INLINE Triple<Real> operator-(const Triple<Real>& a, const Triple<Real>& b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Factor, class Real>
TALUS_INLINE Triple<Real> operator*(Factor s, const Triple<Real>& a) noexcept {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Real>
TALUS_INLINE Real dot(const Triple<Real>& a, const Triple<Real>& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
TALUS_INLINE Triple<Real> cross(const Triple<Real>& a, const Triple<Real>& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Where the condition holds a, else b, component by component.
template <class Mask, class Real>
TALUS_INLINE Triple<Real> select(Mask condition, const Triple<Real>& a, const Triple<Real>& b) noexcept {
  return {condition ? a.x : b.x, condition ? a.y : b.y, condition ? a.z : b.z};
}
template <class Real>
TALUS_INLINE Triple<Real> triple(const Quad<Real>& q) noexcept {
  return {q.x, q.y, q.z};
}
template <class Real>
TALUS_INLINE Quad<Real> quad(const Triple<Real>& t, Real w) noexcept {
  return {t.x, t.y, t.z, w};
}
TALUS_INLINE double length(const Triple<double>& a) noexcept {
  return std::sqrt(dot(a, a));
}
TALUS_INLINE Row row(const Triple<double>& t, double w = 0) noexcept {
  return Row{{t.x, t.y, t.z, w}};
}
TALUS_INLINE void add(Row& to, const Triple<double>& t) noexcept {
  to.x += t.x;
  to.y += t.y;
  to.z += t.z;
}

TALUS_INLINE double component(const Row& r, int k) noexcept {
  return k == 0 ? r.x : k == 1 ? r.y : r.z;
}

TALUS_INLINE Lanes load(const Row& row) noexcept {
  return *reinterpret_cast<const Lanes*>(&row);
}
TALUS_INLINE void store(Row& row, Lanes value) noexcept {
  *reinterpret_cast<Lanes*>(&row) = value;
}

/// Four rows seen as four lanes of each component, and back: a 4 x 4 transposition.
TALUS_INLINE Quad<Lanes> transposed(Lanes a, Lanes b, Lanes c, Lanes d) noexcept {
  const Lanes ab_xz = __builtin_shufflevector(a, b, 0, 4, 2, 6),
              ab_yw = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes cd_xz = __builtin_shufflevector(c, d, 0, 4, 2, 6),
              cd_yw = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return {
      __builtin_shufflevector(ab_xz, cd_xz, 0, 1, 4, 5), __builtin_shufflevector(ab_yw, cd_yw, 0, 1, 4, 5),
      __builtin_shufflevector(ab_xz, cd_xz, 2, 3, 6, 7), __builtin_shufflevector(ab_yw, cd_yw, 2, 3, 6, 7)};
}

}  // namespace talus::dem
