#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

/// Numbers as text that takes little room in a page: whole numbers, little-endian, in base64.
namespace talus::report {

std::string base64(std::span<const std::uint8_t> bytes);

std::string packed(std::span<const std::uint16_t> numbers);
std::string packed(std::span<const std::uint32_t> numbers);
std::string packed(std::span<const float> numbers);

/// From the least to the largest value of a list.
struct Range {
  double low = 0, high = 0;
  void take(double value) {
    low = value < low ? value : low;
    high = value > high ? value : high;
  }
  /// How far apart two neighbouring ones of `steps + 1` values are that fill the range.
  double step(int steps) const { return (high - low) / steps; }
};

/// To take values into.
constexpr Range nothing_yet{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
constexpr std::array<Range, 3> empty_box{nothing_yet, nothing_yet, nothing_yet};

/// Nothing has the range from 0 to 0.
Range range_of(std::span<const double> values);

/// The nearest of the `steps + 1` values that fill the range, by its number from 0 on.
std::uint32_t quantised(double value, const Range& range, int steps);

}  // namespace talus::report
