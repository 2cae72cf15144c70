#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/vector3.hpp"

/// How a section of a scene is declared: once, in a function `void describe(Fields&, Section&)` beside the
/// section's struct. The same description reads the YAML strictly and prints the schema page (reader.hpp),
/// and names the allowed keys in errors.
///
///     struct GravityScene { Vector3 acceleration; };
///     void describe(core::Fields& fields, GravityScene& gravity) {
///       fields.required("acceleration", gravity.acceleration, {.unit = "m/s^2", .help = "acceleration of
///       free fall"});
///     }
///
/// Presence is the switch: an optional section or value that the scene does not name stays std::nullopt.
namespace talus::core {

/// Allowed values of a number, in the SI unit of its key.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_included = true;
  bool high_included = true;
};
inline constexpr Range any{};
inline constexpr Range positive{.low = 0, .low_included = false};
inline constexpr Range not_negative{.low = 0};
inline constexpr Range fraction{.low = 0, .high = 1};

/// The sizes a value can have by what it means; 0 always can. A value outside of `possible` is refused where it is
/// written with a unit, or its key has none: such a value claims to be what it says. A plain number outside, and
/// any value outside of `usual`, is read with a warning, as the whole scene may be in other units.
struct Plausible {
  Range usual = any;
  Range possible = any;
  const char* hint = "";  ///< what may have been meant, and how it is written
};

/// What a key says of itself. `unit` is the SI unit a plain number is taken in ("" for a dimensionless one);
/// a string value such as "4 mm" is converted to it and refused where its dimension differs. The two columns
/// of a table of pairs have a unit each: "m, N". The range holds for every number of a list, vector or table,
/// and for each component; so does what is plausible (plausible.hpp).
struct KeyTraits {
  const char* unit = "";
  Range range = any;
  const char* help = "";  ///< one line of the schema page, no full stop
  Plausible plausible = {};
};

class Fields;

/// A value a key can hold without being a section of its own. A path is made absolute or relative to the
/// working directory from the folder of the file it is written in, and must exist.
using ScalarSlot = std::variant<double*, std::int64_t*, bool*, std::string*, std::filesystem::path*, Vector3*,
                                std::vector<double>*, std::vector<std::int64_t>*, std::vector<std::string>*,
                                std::vector<Vector3>*, std::vector<std::pair<double, double>>*>;

enum class Presence { required, optional, with_default };

/// The names of an enumeration's values, in their order: choices({"x", "y", "z"}).
using Choices = std::vector<const char*>;

/// A section seen as its keys. Implemented by the reader and by the schema printer. Calls come in the order
/// of the schema page.
class Fields {
 public:
  virtual ~Fields() = default;

  template <class T>
  void required(const char* key, T& value, KeyTraits traits) {
    scalar(key, &value, Presence::required, traits, [] {});
  }
  /// A key that may be missing; `value` keeps its present content as the default, which the schema page
  /// shows.
  template <class T>
  void with_default(const char* key, T& value, KeyTraits traits) {
    scalar(key, &value, Presence::with_default, traits, [] {});
  }
  template <class T>
  void optional(const char* key, std::optional<T>& value, KeyTraits traits) {
    auto slot = std::make_shared<T>();
    scalar(key, slot.get(), Presence::optional, traits, [slot, &value] { value = *slot; });
  }

  template <class Enum>
  void choice(const char* key, Enum& value, const Choices& names, const char* help,
              Presence presence = Presence::with_default) {
    choose(key, static_cast<int>(value), names, help, presence,
           [&value](int i) { value = static_cast<Enum>(i); });
  }

  /// A nested section; the help text heads it on the schema page.
  template <class Section>
  void section(const char* key, Section& value, const char* help) {
    nested(key, Presence::required, help, [&value](Fields& inner) { describe(inner, value); });
  }
  template <class Section>
  void section(const char* key, std::optional<Section>& value, const char* help) {
    nested(key, Presence::optional, help, [&value](Fields& inner) { describe(inner, value.emplace()); });
  }
  /// A list of sections: `supports: [{...}, {...}]`. `least` is the smallest allowed number of entries.
  template <class Section>
  void list(const char* key, std::vector<Section>& values, const char* help, std::size_t least = 0) {
    nested_list(key, least, help, [&values](Fields& inner) { describe(inner, values.emplace_back()); });
  }
  /// Named sections, in the order of the file: `parts: {net: {...}, rope: {...}}`. Names are letters, digits,
  /// _ and -.
  template <class Section>
  void map(const char* key, std::vector<std::pair<std::string, Section>>& values, const char* help,
           std::size_t least = 0) {
    nested_map(key, least, help, [&values](const std::string& name, Fields& inner) {
      describe(inner, values.emplace_back(name, Section{}).second);
    });
  }
  /// Exactly one of several sections, told apart by its key: `cable: {...}` or `membrane: {...}` at this
  /// level. Each alternative is a pair of key and help text, in the order of the variant's types;
  /// std::monostate first makes the choice optional.
  struct Alternative {
    const char* key;
    const char* help;
  };
  template <class... Sections>
  void one_of(std::variant<Sections...>& value, const std::vector<Alternative>& alternatives) {
    one_of_impl(value, alternatives, std::index_sequence_for<Sections...>{});
  }

  /// A rule that ties keys together. `holds` is false where the scene breaks it; `key` names the place
  /// complained about and `message` one sentence with the values. Where the section already has a complaint
  /// the rule is not judged, because its values are not those of the scene. The schema printer ignores rules.
  virtual void rule(bool holds, const char* key, const std::string& message) = 0;
  /// The file and line this section stands at, for errors found later (empty in the schema printer).
  virtual std::string place() const = 0;

  // What the templates above come down to. `assign` runs after the slot is filled, and only where the key is
  // present.
  using Assign = std::function<void()>;
  using Describe = std::function<void(Fields&)>;
  virtual void scalar(const char* key, ScalarSlot slot, Presence presence, KeyTraits traits,
                      Assign assign) = 0;
  virtual void choose(const char* key, int default_index, const Choices& names, const char* help,
                      Presence presence, std::function<void(int)> assign) = 0;
  virtual void nested(const char* key, Presence presence, const char* help, Describe describe) = 0;
  virtual void nested_list(const char* key, std::size_t least, const char* help, Describe describe_one) = 0;
  virtual void nested_map(const char* key, std::size_t least, const char* help,
                          std::function<void(const std::string&, Fields&)> describe_one) = 0;
  virtual void nested_choice(const std::vector<Alternative>& alternatives, Presence presence,
                             std::function<void(std::size_t, Fields&)> describe_one) = 0;

 private:
  template <class... Sections, std::size_t... I>
  void one_of_impl(std::variant<Sections...>& value, const std::vector<Alternative>& alternatives,
                   std::index_sequence<I...>) {
    using First = std::variant_alternative_t<0, std::variant<Sections...>>;
    constexpr bool may_be_absent = std::is_same_v<First, std::monostate>;
    constexpr std::size_t offset = may_be_absent ? 1 : 0;
    nested_choice(
        alternatives, may_be_absent ? Presence::optional : Presence::required,
        [&value](std::size_t chosen, Fields& inner) {
          (void)((I == chosen + offset ? (describe_alternative<I>(value, inner), true) : false) || ...);
        });
  }
  template <std::size_t I, class Variant>
  static void describe_alternative(Variant& value, Fields& inner) {
    if constexpr (!std::is_same_v<std::variant_alternative_t<I, Variant>, std::monostate>)
      describe(inner, value.template emplace<I>());
  }
};

}  // namespace talus::core
