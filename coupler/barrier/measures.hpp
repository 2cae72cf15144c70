#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "coupler/barrier/layout.hpp"

namespace talus::barrier {

/// Where a net hangs: how far up the slope it reaches within the block's path (m).
/// @param result of a stage, with fields
/// @throws ConfigError where the result has no fields of the net
double net_reaches(const std::filesystem::path& result, const Layout& layout);

/// What a test body measures in one impact, from the result of its run: lengths, heights, forces, energies
/// (docs/barriers.md says how each is meant). A number that the result does not hold is null.
/// @throws ConfigError where a table of the result cannot be read
nlohmann::json measured(const std::filesystem::path& result, const BarrierSheet& sheet, const Layout& layout);

}  // namespace talus::barrier
