#pragma once

#include <cstdint>
#include <vector>

#include "core/output/field_reader.hpp"

namespace talus::report {

/// The cells of a group that are drawn, with their nodes counted anew, so that only the nodes they need go onto the
/// page.
struct Drawing {
  const core::GroupDescription* group = nullptr;
  std::vector<std::int64_t> nodes;   ///< of the group
  std::vector<std::uint32_t> cells;  ///< indices into `nodes`
  std::int64_t stride = 1;           ///< every stride-th cell of the group
  std::int64_t cell_count() const {
    return static_cast<std::int64_t>(cells.size()) / static_cast<int>(group->kind);
  }
};

/// Every stride-th cell, so that at most so many are drawn.
Drawing drawing_of(const core::GroupDescription& group, std::int64_t most_cells);

bool has_field(const core::GroupDescription& group, const char* name);

/// Of a field by nodes, the values of the drawing's nodes.
std::vector<double> at_nodes(const Drawing& drawing, const std::vector<double>& values,
                             std::size_t components);
/// Of a field by cells with one component, the values of the drawing's cells.
std::vector<double> at_cells(const Drawing& drawing, const std::vector<double>& values);

}  // namespace talus::report
