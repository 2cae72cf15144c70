#pragma once

#include <string>

#include "core/scene/fields.hpp"
#include "core/scene/section_reader.hpp"
#include "core/scene/tree.hpp"

namespace talus::core {

/// What a key wants: "a length such as '4 mm'", "a list of 3 ...".
std::string expected_value(const ScalarSlot& slot, const KeyTraits& traits);
/// The range in words: "greater than 0 m^2", "between 0 and 1"; empty for any number.
std::string range_text(const Range& range, const std::string& unit);

/// Fills the slot from the node. False, with complaints, where the node does not hold such a value; the slot
/// is then unchanged.
bool read_value(const SceneNode& node, const Location& location, const ScalarSlot& slot,
                const KeyTraits& traits, std::vector<Complaint>& complaints);

}  // namespace talus::core
