#pragma once

#include <optional>
#include <string>

/// Units of measure as scenes write them, through UDUNITS-2 ("mm", "N/mm^2", "1/s", "deg"). Angles, angular
/// velocities, frequencies and plain numbers are four kinds that never turn into each other, although all are
/// powers of seconds to UDUNITS.
namespace talus::core {

struct UnitConversion {
  enum class Outcome { ok, unknown_unit, other_dimension };
  Outcome outcome = Outcome::unknown_unit;
  double value = 0;  ///< in the SI unit asked for, where the outcome is `ok`
};

/// A number with the unit it is given in, and the unit it is wanted in.
struct Quantity {
  double value = 0;
  std::string unit;
};

/// Converts to the unit `wanted` (e.g. "m", "Pa", "" for a plain number). Units with an offset (degrees
/// Celsius) and products with numbers
/// ("3 m") are unknown on purpose. Safe to call from several threads. Exact where the factor is a power of
/// ten: 50 us is 5e-5 s to the bit.
UnitConversion convert(const Quantity& given, const std::string& wanted);

/// What a value is that differs from the wanted kind by an angle alone, and what to write where that is clear:
/// "an angle; its tangent is 0.57735" for 30 deg where a number is wanted. Empty for any other value.
std::string other_kind(const Quantity& given, const std::string& wanted);

/// A number with or without a unit, "50 us" or "0.2", in the unit `wanted`; nothing where the text is no such
/// value.
std::optional<double> parse_quantity(const std::string& text, const std::string& wanted);

/// "a length such as '4 mm'" for "m"; "a plain number" for "".
std::string expected_quantity(const std::string& unit);

/// A value for people: three significant digits and the prefix that makes it short, e.g. readable(5e-5, "s")
/// is "50 us".
std::string readable(double value, const std::string& unit);

}  // namespace talus::core
