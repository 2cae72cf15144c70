#pragma once

#include <map>
#include <string>

#include "core/output/field_reader.hpp"

namespace talus::report {

/// Groups by the group of the structure, or else the earlier one, that they lie on in the first, the middle and the last
/// frame: a boundary that is moved by a structure is drawn as the structure, which has more to show. It may be off by
/// what moved since their last exchange, a thousandth of the group's size.
/// @pre there is a frame
std::map<std::string, std::string> doubles(const core::FieldReader& fields);

}  // namespace talus::report
