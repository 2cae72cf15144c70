#include "core/scene/values.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/input_file.hpp"
#include "core/units/units.hpp"

namespace talus::core {
namespace {

/// What a value is checked against, and where complaints about it go.
struct Reading {
  Location location;
  KeyTraits traits;
  std::vector<Complaint>& complaints;

  void complain(const SceneNode& node, const std::string& message) {
    complaints.push_back(
        complaint(node.place.line ? node.place : location.place, location.key_path, message));
  }
  void warn(const SceneNode& node, const std::string& message) {
    complain(node, message);
    complaints.back().warning = true;
  }
  Reading item(std::size_t index) const {
    return {{fmt::format("{}[{}]", location.key_path, index), location.place}, traits, complaints};
  }
};

std::string with_unit(double value, const std::string& unit) {
  const char* blank = unit.empty() ? "" : " ";
  if (std::abs(value) >= 1e9) return fmt::format("{:g}{}{}", value, blank, unit);  // no rows of zeros
  return fmt::format("{}{}{}", value, blank, unit);
}

bool in_range(double value, const Range& range) {
  return (range.low_included ? value >= range.low : value > range.low) &&
         (range.high_included ? value <= range.high : value < range.high);
}

bool check_range(double value, const SceneNode& node, Reading& reading) {
  if (in_range(value, reading.traits.range)) return true;
  const bool bare = node.scalar.find_first_not_of("+-.0123456789eE") == std::string::npos;
  const std::string unit = bare && *reading.traits.unit ? std::string(" ") + reading.traits.unit : "";
  reading.complain(
      node, fmt::format("must be {}, but is {}{}", range_text(reading.traits.range, reading.traits.unit),
                        node.scalar, unit));
  return false;
}

/// @param claimed the value says what it is: a unit is written, or its key has none
bool check_plausible(double value, bool claimed, const SceneNode& node, Reading& reading) {
  const auto& [usual, possible, hint] = reading.traits.plausible;
  const std::string unit = reading.traits.unit;
  const double size = std::abs(value);
  const bool can_be = in_range(size, possible) || size == 0;
  if (can_be && (in_range(size, usual) || size == 0)) return true;
  const std::string given = unit.empty() || !claimed ? "" : quoted(node.scalar) + " ";
  const bool refused = !can_be && claimed;
  if (refused)
    reading.complain(node, fmt::format("{}is {}, but must be {}: {}", given, readable(value, unit),
                                       range_text(possible, unit), hint));
  else
    reading.warn(node, fmt::format("{}is {}, which is unusual (usually {}): {}", given, readable(value, unit),
                                   range_text(can_be ? usual : possible, unit), hint));
  return !refused;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

bool spells_not_finite(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  if (text.starts_with('.')) text.remove_prefix(1);
  std::string lower(text.substr(0, 8));
  for (auto& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower == "inf" || lower == "infinity" || lower == "nan";
}

/// The number at the front of `text`, which then holds what follows it.
std::optional<double> take_number(std::string_view& text, std::errc& error) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  error = code;
  if (code != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

std::optional<double> converted(double number, const std::string& unit, const SceneNode& node,
                                Reading& reading) {
  const std::string wanted = expected_quantity(reading.traits.unit);
  const auto conversion = convert({number, unit}, reading.traits.unit);
  switch (conversion.outcome) {
    case UnitConversion::Outcome::ok:
      return conversion.value;
    case UnitConversion::Outcome::unknown_unit:
      reading.complain(node, fmt::format("expects {}, got {}; {} is no known unit", wanted,
                                         quoted(node.scalar), quoted(unit)));
      break;
    case UnitConversion::Outcome::other_dimension: {
      const std::string kind = other_kind({number, unit}, reading.traits.unit);
      reading.complain(node, fmt::format("expects {}, got {}{}{}", wanted, quoted(node.scalar),
                                         kind.empty() ? "" : ", which is ", kind));
      break;
    }
  }
  return std::nullopt;
}

bool read(const SceneNode& node, double& value, Reading reading) {
  const std::string wanted = expected_quantity(reading.traits.unit);
  std::string_view text = trimmed(node.scalar);
  std::errc error{};
  std::optional<double> number;
  if (node.kind == SceneNode::Kind::scalar && !spells_not_finite(text)) number = take_number(text, error);
  if (!number) {
    const bool not_finite = node.kind == SceneNode::Kind::scalar && spells_not_finite(text);
    const char* why = not_finite                                ? ", which is not finite"
                      : error == std::errc::result_out_of_range ? ", which no double can hold"
                                                                : "";
    reading.complain(node, fmt::format("expects {}, got {}{}", wanted, shown(node), why));
    return false;
  }
  const std::string unit(trimmed(text));
  if (!unit.empty()) number = converted(*number, unit, node, reading);
  if (!number) return false;
  if (!std::isfinite(*number)) {
    reading.complain(
        node, fmt::format("expects {}, got {}, which no double can hold", wanted, quoted(node.scalar)));
    return false;
  }
  const bool claimed = !unit.empty() || *reading.traits.unit == 0;
  if (!check_range(*number, node, reading) || !check_plausible(*number, claimed, node, reading)) return false;
  value = *number;
  return true;
}

bool read(const SceneNode& node, std::int64_t& value, Reading reading) {
  const std::string_view text = trimmed(node.scalar);
  std::int64_t number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (node.kind != SceneNode::Kind::scalar || code != std::errc{} || end != text.data() + text.size()) {
    reading.complain(node, fmt::format("expects a whole number, got {}", shown(node)));
    return false;
  }
  if (!check_range(static_cast<double>(number), node, reading)) return false;
  value = number;
  return true;
}

bool read(const SceneNode& node, bool& value, Reading reading) {
  if (node.kind != SceneNode::Kind::scalar || (node.scalar != "true" && node.scalar != "false")) {
    reading.complain(node, fmt::format("expects true or false, got {}", shown(node)));
    return false;
  }
  value = node.scalar == "true";
  return true;
}

bool read(const SceneNode& node, std::string& value, Reading reading) {
  if (node.kind != SceneNode::Kind::scalar) {
    reading.complain(node, fmt::format("expects a word, got {}", shown(node)));
    return false;
  }
  value = node.scalar;
  return true;
}

bool read(const SceneNode& node, std::filesystem::path& value, Reading reading) {
  if (node.kind != SceneNode::Kind::scalar) {
    reading.complain(node, fmt::format("expects the path of a file, got {}", shown(node)));
    return false;
  }
  const std::filesystem::path folder =
      node.place.file ? node.place.file->parent_path() : std::filesystem::path();
  const std::filesystem::path path = folder / node.scalar;
  if (const std::string fault = input_file_fault(path); !fault.empty()) {
    reading.complain(node, fault);
    return false;
  }
  value = path;
  return true;
}

bool is_list(const SceneNode& node, std::size_t length, const Reading& reading) {
  if (node.kind == SceneNode::Kind::list && (length == 0 || node.items.size() == length)) return true;
  const std::string count = length ? fmt::format("{} values", length) : "values";
  Reading(reading).complain(node, fmt::format("expects a list of {}, got {}", count, shown(node)));
  return false;
}

bool read(const SceneNode& node, Vector3& value, Reading reading) {
  if (!is_list(node, 3, reading)) return false;
  Vector3 found;
  bool good = true;
  for (int i = 0; i < 3; ++i)
    good &=
        read(node.items[static_cast<std::size_t>(i)], found[i], reading.item(static_cast<std::size_t>(i)));
  if (good) value = found;
  return good;
}

bool read(const SceneNode& node, std::pair<double, double>& value, Reading reading) {
  if (!is_list(node, 2, reading)) return false;
  const std::string units = reading.traits.unit;
  const auto comma = units.find(',');
  const std::string first = units.substr(0, comma);
  const std::string second =
      comma == std::string::npos ? first : std::string(trimmed(std::string_view(units).substr(comma + 1)));
  std::pair<double, double> found;
  Reading left = reading.item(0), right = reading.item(1);
  left.traits.unit = first.c_str();
  right.traits.unit = second.c_str();
  const bool good_left = read(node.items[0], found.first, left);
  const bool good = read(node.items[1], found.second, right) && good_left;
  if (good) value = found;
  return good;
}

template <class T>
bool read(const SceneNode& node, std::vector<T>& values, Reading reading) {
  if (!is_list(node, 0, reading)) return false;
  std::vector<T> found(node.items.size());
  bool good = true;
  for (std::size_t i = 0; i < found.size(); ++i) good &= read(node.items[i], found[i], reading.item(i));
  if (good) values = std::move(found);
  return good;
}

struct Expectation {
  std::string unit;
  std::string number() const { return expected_quantity(unit); }

  std::string operator()(const double*) const { return number(); }
  std::string operator()(const std::int64_t*) const { return "a whole number"; }
  std::string operator()(const bool*) const { return "true or false"; }
  std::string operator()(const std::string*) const { return "a word"; }
  std::string operator()(const std::filesystem::path*) const { return "the path of a file"; }
  std::string operator()(const Vector3*) const { return "a list of 3, each " + number(); }
  std::string operator()(const std::vector<double>*) const { return "a list, each " + number(); }
  std::string operator()(const std::vector<std::int64_t>*) const { return "a list of whole numbers"; }
  std::string operator()(const std::vector<std::string>*) const { return "a list of words"; }
  std::string operator()(const std::vector<Vector3>*) const {
    return "a list of lists of 3, each " + number();
  }
  std::string operator()(const std::vector<std::pair<double, double>>*) const {
    return fmt::format("a list of pairs in ({})", unit);
  }
};

}  // namespace

std::string expected_value(const ScalarSlot& slot, const KeyTraits& traits) {
  return std::visit(Expectation{traits.unit}, slot);
}

std::string range_text(const Range& range, const std::string& unit) {
  const bool has_low = std::isfinite(range.low), has_high = std::isfinite(range.high);
  const std::string low = with_unit(range.low, unit), high = with_unit(range.high, unit);
  const std::string above = (range.low_included ? "at least " : "greater than ") + low;
  const std::string below = (range.high_included ? "at most " : "less than ") + high;
  if (has_low && has_high && range.low_included && range.high_included)
    return fmt::format("between {} and {}", range.low, high);
  if (has_low && has_high) return above + " and " + below;
  return has_low ? above : has_high ? below : std::string();
}

bool read_value(const SceneNode& node, const Location& location, const ScalarSlot& slot,
                const KeyTraits& traits, std::vector<Complaint>& complaints) {
  return std::visit(
      [&](auto* value) {
        return read(node, *value, Reading{location, traits, complaints});
      },
      slot);
}

}  // namespace talus::core
