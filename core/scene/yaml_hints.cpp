#include "core/scene/yaml_hints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace talus::core {
namespace {

std::string without_blanks(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// "title: Net: with a rock" as its key and its value, the comment left off.
struct KeyedLine {
  std::string key, value;
};
std::optional<KeyedLine> keyed(const std::string& line) {
  const auto colon = line.find(": ");
  if (colon == std::string::npos) return std::nullopt;
  const std::string rest = line.substr(colon + 1);
  return KeyedLine{without_blanks(line.substr(0, colon)), without_blanks(rest.substr(0, rest.find(" #")))};
}

bool indented_by_tab(const std::string& line) {
  return line.substr(0, line.find_first_not_of(" \t")).find('\t') != std::string::npos;
}

std::string in_quotes(const KeyedLine& line) {
  const char quote = line.value.find('"') == std::string::npos ? '"' : '\'';
  return fmt::format("{}: {}{}{}", line.key, quote, line.value, quote);
}

std::string value_hint(const KeyedLine& line) {
  const std::string& value = line.value;
  if (value.empty()) return {};
  const char first = value.front();
  if (first == '\'' || first == '"') {
    const bool odd = std::ranges::count(value, first) % 2 != 0;
    return odd ? "a quote inside of a quoted text: put the text in quotes of the other kind" : "";
  }
  const bool colon = value.find(": ") != std::string::npos || value.ends_with(':');
  if (first == '[' || first == '{')
    return colon ? "inside of [ ] and { } a text with a colon needs quotes, and every bracket its partner"
                 : "";
  if (colon) return "a text with a colon needs quotes: " + in_quotes(line);
  if (std::string_view("*&!|>@`%,?").find(first) != std::string_view::npos)
    return fmt::format("a text that starts with {} needs quotes: {}", first, in_quotes(line));
  return {};
}

/// "end:1", which YAML takes for a text.
bool misses_blank(const std::string& line) {
  const std::string text = without_blanks(line);
  const auto colon = text.find(':');
  return colon != std::string::npos && colon > 0 && colon + 1 < text.size() && text[colon + 1] != ' ';
}

}  // namespace

std::string yaml_hint(const std::string& line, const std::string& before) {
  std::string hint;
  if (indented_by_tab(line)) hint = "this line is indented with a tab; YAML wants spaces";
  if (const auto pair = keyed(line); hint.empty() && pair) hint = value_hint(*pair);
  if (hint.empty() && misses_blank(before)) hint = "the line above has no blank after its colon";
  return hint.empty() ? "" : " (" + hint + ")";
}

}  // namespace talus::core
