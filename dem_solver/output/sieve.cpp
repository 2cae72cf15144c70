#include "dem_solver/output/sieve.hpp"

#include <array>
#include <cmath>

namespace talus::dem {

namespace {
constexpr std::array preferred{1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0};
constexpr int a_decade = static_cast<int>(preferred.size());
}  // namespace

double sieve_opening(int number) noexcept {
  const int decade = static_cast<int>(std::floor(static_cast<double>(number) / a_decade));
  const double mantissa = preferred[static_cast<std::size_t>(number - decade * a_decade)];
  // A division by a power of ten gives the double that is written 0.08; a product with 0.01 may not.
  return decade < 0 ? mantissa / std::pow(10.0, -decade) : mantissa * std::pow(10.0, decade);
}

int sieve_that_holds(double diameter) noexcept {
  int number = static_cast<int>(std::floor(a_decade * std::log10(diameter)));
  while (sieve_opening(number) > diameter) --number;
  while (sieve_opening(number + 1) <= diameter) ++number;
  return number;
}

}  // namespace talus::dem
