#pragma once

#include <string>

namespace talus::core {

/// What is likely wrong with a line that is no YAML and what to write instead, as a text to follow the
/// parser's own words: " (a text with a colon needs quotes: title: \"Net: with a rock\")". Empty where nothing
/// is known.
/// @param line the line the parser stopped at; `before` the one above
std::string yaml_hint(const std::string& line, const std::string& before);

}  // namespace talus::core
