#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/output/field_reader.hpp"
#include "coupler/report/drawing.hpp"

namespace talus::report {

/// Whether a field of the group colours its cells in the replay: its axial force, or its stress.
bool is_coloured(const core::GroupDescription& group);

/// Adds to the groups of the replay, one a drawing, a number of 8 bits for each cell and frame, and returns the scales
/// they belong to. One scale for all groups that are coloured by the same quantity, so that equal colours are equal
/// values. 255 stands for a cell that is broken.
nlohmann::json add_colours(nlohmann::json& groups, const core::FieldReader& fields,
                           const std::vector<Drawing>& drawings, const std::vector<std::int64_t>& frames);

}  // namespace talus::report
