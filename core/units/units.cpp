#include "core/units/units.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace talus::core {
namespace {

using UnitPointer = std::unique_ptr<ut_unit, decltype(&ut_free)>;
using SystemPointer = std::unique_ptr<ut_system, decltype(&ut_free_system)>;
using ConverterPointer = std::unique_ptr<cv_converter, decltype(&cv_free)>;

/// Powers of the basic units a unit is made of, N being {kilogram: 1, meter: 1, second: -2}. The radian is one
/// of them, although UDUNITS converts it to 1: an angle is no number, and a frequency no angular velocity.
using Dimension = std::map<std::string, int>;
constexpr const char* radian = "radian";

/// Collects a Dimension, as UDUNITS shows a unit's inside only to visitors.
class DimensionVisitor {
 public:
  /// Nothing for units that are no power of others: logarithms such as dB, dates.
  static std::optional<Dimension> of(const ut_unit* unit) {
    static const ut_visitor visitor{visit_basic, visit_product, visit_galilean, visit_timestamp,
                                    visit_logarithmic};
    Dimension dimension;
    if (ut_accept_visitor(unit, &visitor, &dimension) != UT_SUCCESS) return std::nullopt;
    return dimension;
  }

 private:
  static Dimension& collected(void* argument) { return *static_cast<Dimension*>(argument); }
  static std::string name_of(const ut_unit* basic) {
    const char* name = ut_get_name(basic, UT_ASCII);
    if (!name) name = ut_get_symbol(basic, UT_ASCII);
    return name ? name : "";
  }
  static ut_status visit_basic(const ut_unit* unit, void* argument) {
    collected(argument)[name_of(unit)] = 1;
    return UT_SUCCESS;
  }
  static ut_status visit_product(const ut_unit*, int count, const ut_unit* const* units, const int* powers,
                                 void* argument) {
    for (int i = 0; i < count; ++i)
      if (powers[i] != 0) collected(argument)[name_of(units[i])] = powers[i];
    return UT_SUCCESS;
  }
  static ut_status visit_galilean(const ut_unit*, double, const ut_unit* underlying, double, void* argument) {
    const auto inner = of(underlying);
    if (!inner) return UT_MEANINGLESS;
    collected(argument) = *inner;
    return UT_SUCCESS;
  }
  static ut_status visit_timestamp(const ut_unit*, const ut_unit*, double, void*) { return UT_MEANINGLESS; }
  static ut_status visit_logarithmic(const ut_unit*, double, const ut_unit*, void*) { return UT_MEANINGLESS; }
};

/// UDUNITS' parser keeps global state, so one lock guards every call; found factors are remembered.
class UnitSystem {
 public:
  UnitSystem() : system_(read_system(), &ut_free_system) {
    const UnitPointer degree = parse("degree"), turn = parse("turn");
    ut_map_name_to_unit("deg", UT_ASCII, degree.get());
    ut_map_name_to_unit("rev", UT_ASCII, turn.get());
  }

  UnitConversion factor(const std::string& unit, const std::string& wanted) {
    const std::lock_guard lock(mutex_);
    const auto [found, is_new] = factors_.try_emplace({unit, wanted});
    if (is_new) found->second = find_factor(unit, wanted);
    return found->second;
  }
  /// What UDUNITS multiplies with, to which radians are numbers. @pre both are units that it converts
  double ratio(const std::string& unit, const std::string& to) {
    const std::lock_guard lock(mutex_);
    const UnitPointer from = parse(unit), target = parse(to);
    const ConverterPointer converter(ut_get_converter(from.get(), target.get()), &cv_free);
    return cv_convert_double(converter.get(), 1);
  }
  /// Nothing for what is no unit.
  std::optional<Dimension> dimension(const std::string& unit) {
    const std::lock_guard lock(mutex_);
    const UnitPointer parsed = parse(unit);
    return parsed ? DimensionVisitor::of(parsed.get()) : std::nullopt;
  }

 private:
  static ut_system* read_system() {
    ut_set_error_message_handler(ut_ignore);
    ut_system* system = ut_read_xml(nullptr);
    if (!system)
      throw std::runtime_error("the unit database of UDUNITS-2 cannot be read (package libudunits2-data)");
    return system;
  }
  UnitPointer parse(const std::string& unit) const {
    return {ut_parse(system_.get(), unit.empty() ? "1" : unit.c_str(), UT_UTF8), &ut_free};
  }
  UnitConversion find_factor(const std::string& unit, const std::string& wanted) const {
    const UnitPointer from = parse(unit), to = parse(wanted);
    if (!to) throw std::logic_error("'" + wanted + "' is no unit");
    const auto dimension = from ? DimensionVisitor::of(from.get()) : std::nullopt;
    if (!dimension) return {UnitConversion::Outcome::unknown_unit, 0};
    // Asked before the converter, which takes radians for numbers and turns a time into a frequency.
    if (dimension != DimensionVisitor::of(to.get())) return {UnitConversion::Outcome::other_dimension, 0};
    const ConverterPointer converter(ut_get_converter(from.get(), to.get()), &cv_free);
    if (!converter) return {UnitConversion::Outcome::other_dimension, 0};
    if (cv_convert_double(converter.get(), 0) != 0)
      return {UnitConversion::Outcome::unknown_unit, 0};  // an offset
    return {UnitConversion::Outcome::ok, cv_convert_double(converter.get(), 1)};
  }

  std::mutex mutex_;
  SystemPointer system_;
  std::map<std::pair<std::string, std::string>, UnitConversion> factors_;
};

UnitSystem& unit_system() {
  static UnitSystem system;
  return system;
}

/// Refuses what UDUNITS would take as a number times a unit: "25 20 m" is a slip, not 500 m.
bool looks_like_unit(std::string_view unit) {
  constexpr std::size_t longest = 40;
  if (unit.size() > longest) return false;
  if (unit.starts_with("1/")) unit.remove_prefix(2);
  bool digit_allowed = false;
  for (const char c : unit) {
    const auto byte = static_cast<unsigned char>(c);
    const bool letter = std::isalpha(byte) || byte >= 128 || c == '%';
    const bool digit = std::isdigit(byte);
    if (!letter && !digit && std::string_view(" /*^.-+()").find(c) == std::string_view::npos) return false;
    if (digit && !digit_allowed) return false;
    digit_allowed = letter || digit || c == '^' || c == '-' || c == '+';
  }
  return !unit.empty();
}

/// `value` times `factor`, by a whole number wherever the factor or its inverse is one: 50 x 1e-6 is not the
/// double nearest to 5e-5, 50 / 1e6 is.
double scaled(double value, double factor) {
  constexpr double tolerance = 4 * std::numeric_limits<double>::epsilon();
  const double whole = std::round(factor), inverse = std::round(1 / factor);
  if (whole >= 1 && std::abs(factor - whole) <= tolerance * factor) return value * whole;
  if (inverse >= 1 && std::abs(factor * inverse - 1) <= tolerance) return value / inverse;
  return value * factor;
}

struct Kind {
  std::string_view unit, noun, example;
};
constexpr std::array kinds{
    Kind{"m", "a length", "4 mm"},
    Kind{"m^2", "an area", "12.6 mm^2"},
    Kind{"m^3", "a volume", "2 m^3"},
    Kind{"m^4", "a second moment of area", "8 cm^4"},
    Kind{"s", "a time", "50 us"},
    Kind{"1/s", "a rate", "20 1/s"},
    Kind{"rad", "an angle", "45 deg"},
    Kind{"rad/s", "an angular velocity", "2 rad/s"},
    Kind{"m/s", "a velocity", "25 m/s"},
    Kind{"m/s^2", "an acceleration", "9.81 m/s^2"},
    Kind{"kg", "a mass", "2.5 t"},
    Kind{"kg/m", "a mass per length", "0.8 kg/m"},
    Kind{"kg/m^2", "a mass per area", "1.5 kg/m^2"},
    Kind{"kg/m^3", "a density", "7850 kg/m^3"},
    Kind{"kg m^2", "a moment of inertia", "40 kg m^2"},
    Kind{"N", "a force", "12 kN"},
    Kind{"N m", "a moment", "3 N m"},
    Kind{"N/m", "a stiffness or force per length", "200 kN/m"},
    Kind{"N s/m", "a viscosity of a dashpot", "40 N s/m"},
    Kind{"N/m^2", "a pressure or stress", "5 kN/m^2"},
    Kind{"Pa", "a stress or modulus", "1770 N/mm^2"},
    Kind{"J", "an energy", "5 kJ"},
};

}  // namespace

UnitConversion convert(const Quantity& given, const std::string& wanted) {
  if (!given.unit.empty() && !looks_like_unit(given.unit)) return {};
  const UnitConversion found = unit_system().factor(given.unit, wanted);
  return {found.outcome, found.outcome == UnitConversion::Outcome::ok ? scaled(given.value, found.value) : 0};
}

std::string other_kind(const Quantity& given, const std::string& wanted) {
  if (!given.unit.empty() && !looks_like_unit(given.unit)) return {};
  auto dimension = unit_system().dimension(given.unit), target = unit_system().dimension(wanted);
  if (!dimension || !target) return {};
  const int turns = (*dimension)[radian], wanted_turns = (*target)[radian];
  dimension->erase(radian), target->erase(radian);
  if (turns == wanted_turns || dimension != target) return {};
  const bool rate = *dimension == Dimension{{"second", -1}};
  if (!rate && !dimension->empty()) return {};
  const double size = given.value * unit_system().ratio(given.unit, rate ? "1/s" : "1");
  if (rate && turns == 0)
    return fmt::format("a frequency; where turns are meant, write '{:.6g} turn/s' or '{:.6g} rad/s'", size,
                       size * 2 * std::numbers::pi);
  if (rate) return turns == 1 ? "an angular velocity" : "";
  return turns == 0   ? "a number"
         : turns == 1 ? fmt::format("an angle; its tangent is {:.6g}", std::tan(size))
                      : "";
}

std::optional<double> parse_quantity(const std::string& text, const std::string& wanted) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || !std::isfinite(number)) return std::nullopt;
  const auto rest = static_cast<std::size_t>(end - text.data());
  const auto unit = text.find_first_not_of(' ', rest);
  if (unit == std::string::npos) return number;
  const auto conversion = convert({number, text.substr(unit)}, wanted);
  return conversion.outcome == UnitConversion::Outcome::ok ? std::optional(conversion.value) : std::nullopt;
}

std::string expected_quantity(const std::string& unit) {
  if (unit.empty()) return "a plain number";
  const auto* kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.unit == unit; });
  if (kind != kinds.end()) return fmt::format("{} such as '{}'", kind->noun, kind->example);
  return fmt::format("a value in {}", unit);
}

std::string readable(double value, const std::string& unit) {
  struct Prefix {
    const char* symbol;
    double factor;
  };
  static constexpr std::array prefixes{Prefix{"G", 1e9},  Prefix{"M", 1e6},  Prefix{"k", 1e3}, Prefix{"", 1},
                                       Prefix{"m", 1e-3}, Prefix{"u", 1e-6}, Prefix{"n", 1e-9}};
  static constexpr std::array prefixed{"m", "s", "N", "Pa", "J", "m/s"};
  const bool takes_prefix = std::find(prefixed.begin(), prefixed.end(), unit) != prefixed.end();
  const double size = std::abs(value);
  if (!takes_prefix || size == 0 || !std::isfinite(value))
    return fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ", unit);
  const bool big_allowed =
      unit != "m" && unit != "s" && unit != "m/s";  // no kilometres of net, no kiloseconds
  for (const auto& prefix : prefixes)
    if ((prefix.factor <= 1 || big_allowed) && size >= prefix.factor * 0.9995)
      return fmt::format("{:.4g} {}{}", value / prefix.factor, prefix.symbol, unit);
  return fmt::format("{:.4g} {}", value, unit);
}

}  // namespace talus::core
