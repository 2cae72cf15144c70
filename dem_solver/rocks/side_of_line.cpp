#include "dem_solver/rocks/side_of_line.hpp"

#include <array>
#include <cmath>

namespace talus::dem {

namespace {

int sign(double x) noexcept {
  return (x > 0) - (x < 0);
}

/// A sum kept without rounding: parts whose digits do not overlap, the largest last.
class ExactSum {
 public:
  void add_product(double a, double b) noexcept {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  int sign_of() const noexcept {
    for (int k = count_ - 1; k >= 0; --k)
      if (parts_[k] != 0) return sign(parts_[k]);
    return 0;
  }

 private:
  /// Knuth's sum of two with its rounding error, carried through all parts.
  void add(double more) noexcept {
    for (int k = 0; k < count_; ++k) {
      const double sum = more + parts_[k], of_part = sum - more;
      parts_[k] = (more - (sum - of_part)) + (parts_[k] - of_part);
      more = sum;
    }
    parts_[count_++] = more;
  }

  std::array<double, 12> parts_{};
  int count_ = 0;
};

int exact_side(const Place& a, const Place& b, const Place& p) noexcept {
  ExactSum sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.y, b.x);
  sum.add_product(-a.x, p.y);
  sum.add_product(a.y, p.x);
  sum.add_product(-p.x, b.y);
  sum.add_product(p.y, b.x);
  return sum.sign_of();
}

}  // namespace

int side_of_line(const Place& a, const Place& b, const Place& p) noexcept {
  const double left = (a.x - p.x) * (b.y - p.y), right = (a.y - p.y) * (b.x - p.x);
  constexpr double round_off = 3.4e-16;  // (3 + 16 u) u with u = 2^-53
  if (std::abs(left - right) > round_off * (std::abs(left) + std::abs(right))) return sign(left - right);
  if (const int side = exact_side(a, b, p); side != 0) return side;
  // The determinant's derivatives along x and y.
  return a.y != b.y ? sign(a.y - b.y) : sign(b.x - a.x);
}

}  // namespace talus::dem
