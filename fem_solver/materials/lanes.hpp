#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>

/// Elements computed side by side in one register. A kernel written for `Real` runs on double and on Lanes
/// with the same operations in the same order, so both give the same bits; where it would branch on a double
/// it selects. The compiler's vector type underneath needs no header (std::experimental::simd costs a second
/// per file that sees it) and becomes whatever the machine has.
namespace talus::fem {

/// Yes or no for each lane.
struct LaneMask {
  using Bits = std::int64_t __attribute__((vector_size(32)));
  Bits bits;  ///< all ones or zero

  friend LaneMask operator&&(const LaneMask& a, const LaneMask& b) noexcept { return {a.bits & b.bits}; }
  friend LaneMask operator||(const LaneMask& a, const LaneMask& b) noexcept { return {a.bits | b.bits}; }
  friend LaneMask operator!(const LaneMask& a) noexcept { return {~a.bits}; }
};

struct Lanes {
  using Pack = double __attribute__((vector_size(32)));
  Pack values{};

  static constexpr std::size_t size() { return 4; }
  Lanes() = default;
  Lanes(double same) noexcept
      : values{same, same, same, same} {}  // numbers in formulas mean the same in every lane
  explicit Lanes(Pack pack) noexcept : values(pack) {}
  /// value(lane) in every lane.
  template <std::invocable<std::size_t> Value>
  explicit Lanes(const Value& value) noexcept : values{value(0), value(1), value(2), value(3)} {}

  double operator[](std::size_t lane) const noexcept { return values[lane]; }
  void set(std::size_t lane, double value) noexcept { values[lane] = value; }

  friend Lanes operator+(const Lanes& a, const Lanes& b) noexcept { return Lanes(a.values + b.values); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) noexcept { return Lanes(a.values - b.values); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) noexcept { return Lanes(a.values * b.values); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) noexcept { return Lanes(a.values / b.values); }
  friend Lanes operator-(const Lanes& a) noexcept { return Lanes(-a.values); }
  friend LaneMask operator<(const Lanes& a, const Lanes& b) noexcept { return {a.values < b.values}; }
  friend LaneMask operator>(const Lanes& a, const Lanes& b) noexcept { return {a.values > b.values}; }
  friend LaneMask operator<=(const Lanes& a, const Lanes& b) noexcept { return {a.values <= b.values}; }
  friend LaneMask operator>=(const Lanes& a, const Lanes& b) noexcept { return {a.values >= b.values}; }
};

inline double select(bool condition, double yes, double no) noexcept {
  return condition ? yes : no;
}
inline Lanes select(const LaneMask& condition, const Lanes& yes, const Lanes& no) noexcept {
  return Lanes(condition.bits ? yes.values : no.values);
}

inline bool any(bool condition) noexcept {
  return condition;
}
inline bool any(const LaneMask& mask) noexcept {
  return (mask.bits[0] | mask.bits[1] | mask.bits[2] | mask.bits[3]) != 0;
}

inline double square_root(double value) noexcept {
  return std::sqrt(value);
}
inline Lanes square_root(const Lanes& value) noexcept {
  Lanes root;
  for (std::size_t lane = 0; lane < Lanes::size(); ++lane) root.set(lane, std::sqrt(value[lane]));
  return root;
}

template <class Real>
Real larger(const Real& a, const Real& b) noexcept {
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
