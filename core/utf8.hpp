#pragma once

#include <cstddef>
#include <string_view>

namespace talus::core {

/// Length in bytes of the longest front part of `text` that is UTF-8: `text.size()` where all of it is.
/// [RFC 3629, section 4: no overlong forms, no surrogates, nothing above U+10FFFF]
std::size_t utf8_length(std::string_view text);

}  // namespace talus::core
