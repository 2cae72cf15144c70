#pragma once

#include <string>

#include "coupler/barrier/layout.hpp"

namespace talus::barrier {

/// The barrier as a scene that `talus run` takes and that a user may edit. Comments say which line of the sheet made which part.
/// @param from name of the sheet, for the first line
std::string scene_text(const LoadedSheet& loaded, const Layout& layout, const std::string& from);

/// One stage of a type test: the barrier alone, or hit by the block.
struct Stage {
  std::string purpose;  ///< for the first line
  std::string start;    ///< value of `structure.start`, in YAML
  bool has_block = true;
  double end = 0;  ///< s
};
/// The same barrier as a scene of one stage, which leaves its state behind. @param layout of this stage's block
std::string stage_text(const LoadedSheet& loaded, const Layout& layout, const Stage& stage);

/// What the sheet leaves to this program and nobody has verified, a line each.
std::string assumptions(const BarrierSheet& sheet);

}  // namespace talus::barrier
