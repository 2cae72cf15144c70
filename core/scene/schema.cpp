#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/scene/reader.hpp"
#include "core/scene/values.hpp"

namespace talus::core {
namespace {

/// The value a key has where the scene does not give it.
struct DefaultText {
  std::string operator()(const double* value) const { return fmt::format("{}", *value); }
  std::string operator()(const std::int64_t* value) const { return fmt::format("{}", *value); }
  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const std::string* value) const { return value->empty() ? "none" : *value; }
  std::string operator()(const std::filesystem::path* value) const {
    return value->empty() ? "none" : value->string();
  }
  std::string operator()(const Vector3* value) const {
    return fmt::format("[{}, {}, {}]", value->x(), value->y(), value->z());
  }
  template <class T>
  std::string operator()(const std::vector<T>* values) const {
    if constexpr (std::is_same_v<T, Vector3>)
      return values->empty() ? "none" : "a list";
    else
      return values->empty() ? "none" : fmt::format("[{}]", fmt::join(*values, ", "));
  }
};

/// One table a section; sections inside come after it, in the order of the description.
class SchemaPrinter final : public Fields {
 public:
  SchemaPrinter(std::string path, const std::string& help) : path_(std::move(path)) {
    head_ = fmt::format("\n## `{}`\n\n{}\n", path_, help);
  }

  std::string markdown() const {
    const std::string table =
        rows_.empty() ? "\nNo keys: `{}`.\n"
                      : "\n| key | value | range | default | meaning |\n|---|---|---|---|---|\n" + rows_;
    return head_ + table + inner_;
  }

  void rule(bool, const char*, const std::string&) override {}
  std::string place() const override { return {}; }
  void scalar(const char* key, ScalarSlot slot, Presence presence, KeyTraits traits, Assign) override {
    const std::string unit = std::string(traits.unit).find(',') == std::string::npos ? traits.unit : "";
    row(key, expected_value(slot, traits), range_and_plausible(traits, unit),
        presence == Presence::with_default ? std::visit(DefaultText{}, slot) : default_of(presence),
        traits.help);
  }
  void choose(const char* key, int default_index, const Choices& names, const char* help, Presence presence,
              std::function<void(int)>) override {
    const auto index = static_cast<std::size_t>(default_index);
    row(key, fmt::format("one of {}", fmt::join(names, ", ")), "",
        presence == Presence::with_default && index < names.size() ? names[index] : default_of(presence),
        help);
  }
  void nested(const char* key, Presence presence, const char* help, Describe describe) override {
    row(key, "a section, see below", "", default_of(presence), help);
    section(path_ + "." + key, help, describe);
  }
  void nested_list(const char* key, std::size_t least, const char* help, Describe describe_one) override {
    row(key, "a list of sections, see below", at_least(least), least ? "required" : "absent", help);
    section(fmt::format("{}.{}[]", path_, key), help, describe_one);
  }
  void nested_map(const char* key, std::size_t least, const char* help,
                  std::function<void(const std::string&, Fields&)> describe_one) override {
    row(key, "sections by name, see below", at_least(least), least ? "required" : "absent", help);
    section(fmt::format("{}.{}.<name>", path_, key), help,
            [&](Fields& inner) { describe_one("name", inner); });
  }
  void nested_choice(const std::vector<Alternative>& alternatives, Presence presence,
                     std::function<void(std::size_t, Fields&)> describe_one) override {
    std::vector<std::string> keys;
    for (const auto& alternative : alternatives) keys.push_back(fmt::format("`{}`", alternative.key));
    for (std::size_t i = 0; i < alternatives.size(); ++i) {
      row(alternatives[i].key, "a section, see below", fmt::format("one of {}", fmt::join(keys, ", ")),
          presence == Presence::required ? "one is required" : "absent", alternatives[i].help);
      section(path_ + "." + alternatives[i].key, alternatives[i].help,
              [&](Fields& inner) { describe_one(i, inner); });
    }
  }

 private:
  static std::string default_of(Presence presence) {
    return presence == Presence::required ? "required" : "absent";
  }
  static std::string at_least(std::size_t least) { return least ? fmt::format("at least {}", least) : ""; }
  static std::string range_and_plausible(const KeyTraits& traits, const std::string& unit) {
    const std::string range = range_text(traits.range, unit),
                      usual = range_text(traits.plausible.usual, unit);
    if (usual.empty()) return range;
    return fmt::format("{}{}usually {}", range, range.empty() ? "" : "; ", usual);
  }
  void row(const char* key, const std::string& value, const std::string& range,
           const std::string& default_text, const std::string& help) {
    rows_ += fmt::format("| `{}` | {} | {} | {} | {} |\n", key, value, range, default_text, help);
  }
  void section(const std::string& path, const std::string& help, const Describe& describe) {
    SchemaPrinter inner(path, help);
    describe(inner);
    inner_ += inner.markdown();
  }

  std::string path_, head_, rows_, inner_;
};

}  // namespace

std::string schema_markdown(const std::string& section, const std::string& help,
                            const std::function<void(Fields&)>& describe) {
  SchemaPrinter printer(section, help);
  describe(printer);
  return printer.markdown();
}

}  // namespace talus::core
