#include "coupler/report/packed.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace talus::report {

namespace {

template <class Number>
std::string packed_numbers(std::span<const Number> numbers) {
  static_assert(std::endian::native == std::endian::little,
                "browsers are little-endian, and so must this be");
  return base64({reinterpret_cast<const std::uint8_t*>(numbers.data()), numbers.size_bytes()});
}

}  // namespace

std::string base64(std::span<const std::uint8_t> bytes) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (k < count ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? letters[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string packed(std::span<const std::uint16_t> numbers) {
  return packed_numbers(numbers);
}
std::string packed(std::span<const std::uint32_t> numbers) {
  return packed_numbers(numbers);
}
std::string packed(std::span<const float> numbers) {
  return packed_numbers(numbers);
}

Range range_of(std::span<const double> values) {
  if (values.empty()) return {};
  const auto [low, high] = std::ranges::minmax(values);
  return {low, high};
}

std::uint32_t quantised(double value, const Range& range, int steps) {
  const double step = range.step(steps);
  return step > 0 ? static_cast<std::uint32_t>(
                        std::clamp(std::round((value - range.low) / step), 0.0, static_cast<double>(steps)))
                  : 0;
}

}  // namespace talus::report
