#include "coupler/report/drawing.hpp"

#include <algorithm>

namespace talus::report {

Drawing drawing_of(const core::GroupDescription& group, std::int64_t most_cells) {
  Drawing drawing{.group = &group, .nodes = {}, .cells = {}};
  drawing.stride = std::max<std::int64_t>(1, (group.cell_count() + most_cells - 1) / most_cells);
  std::vector<std::int64_t> place(static_cast<std::size_t>(group.nodes), -1);
  const auto width = static_cast<std::int64_t>(group.kind);
  for (std::int64_t cell = 0; cell < group.cell_count(); cell += drawing.stride) {
    for (std::int64_t k = 0; k < width; ++k) {
      const auto node = group.cells[static_cast<std::size_t>(cell * width + k)];
      auto& known = place.at(static_cast<std::size_t>(node));
      if (known < 0) {
        known = static_cast<std::int64_t>(drawing.nodes.size());
        drawing.nodes.push_back(node);
      }
      drawing.cells.push_back(static_cast<std::uint32_t>(known));
    }
  }
  return drawing;
}

bool has_field(const core::GroupDescription& group, const char* name) {
  return std::ranges::find(group.fields, name, &core::FieldDescription::name) != group.fields.end();
}

std::vector<double> at_nodes(const Drawing& drawing, const std::vector<double>& values,
                             std::size_t components) {
  std::vector<double> result;
  result.reserve(drawing.nodes.size() * components);
  for (const auto node : drawing.nodes)
    for (std::size_t k = 0; k < components; ++k)
      result.push_back(values[static_cast<std::size_t>(node) * components + k]);
  return result;
}

std::vector<double> at_cells(const Drawing& drawing, const std::vector<double>& values) {
  std::vector<double> result;
  for (std::size_t cell = 0; cell < values.size(); cell += static_cast<std::size_t>(drawing.stride))
    result.push_back(values[cell]);
  return result;
}

}  // namespace talus::report
