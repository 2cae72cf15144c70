#pragma once

#include <string>

#include "coupler/barrier/layout.hpp"

namespace talus::barrier {

/// The barrier as a scene that `talus run` takes and that a user may edit. Comments say which line of the sheet made which part.
/// @param from name of the sheet, for the first line
std::string scene_text(const LoadedSheet& loaded, const Layout& layout, const std::string& from);

/// What the sheet leaves to this program and nobody has verified, a line each.
std::string assumptions(const BarrierSheet& sheet);

}  // namespace talus::barrier
