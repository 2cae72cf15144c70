#pragma once

#include <cmath>
#include <experimental/simd>

/// Elements computed side by side in one register. A kernel written for `Real` runs on double and on Lanes
/// with the same operations in the same order, so both give the same bits; where it would branch on a double
/// it selects.
namespace talus::fem {

using Lanes = std::experimental::native_simd<double>;

inline double select(bool condition, double yes, double no) noexcept {
  return condition ? yes : no;
}
inline Lanes select(const Lanes::mask_type& condition, Lanes yes, const Lanes& no) noexcept {
  std::experimental::where(!condition, yes) = no;
  return yes;
}

inline bool any(bool condition) noexcept {
  return condition;
}
inline bool any(const Lanes::mask_type& condition) noexcept {
  return std::experimental::any_of(condition);
}

inline double square_root(double value) noexcept {
  return std::sqrt(value);
}
inline Lanes square_root(const Lanes& value) noexcept {
  return std::experimental::sqrt(value);
}

inline double larger(double a, double b) noexcept {
  return a < b ? b : a;
}
inline Lanes larger(const Lanes& a, const Lanes& b) noexcept {
  return select(a < b, b, a);
}

/// |value|, and `magnitude` with the sign of `sign`.
template <class Real>
Real magnitude_of(const Real& value) noexcept {
  return select(value < 0, -value, value);
}
template <class Real>
Real signed_like(const Real& sign, const Real& magnitude) noexcept {
  return select(sign < 0, -magnitude, magnitude);
}

}  // namespace talus::fem
