#include "fem_solver/scene/mesh_groups.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/errors.hpp"
#include "core/program/log.hpp"

namespace talus::fem {
namespace {

/// The numbers that the nodes of some cells get among themselves; -1: of no cell.
std::vector<Index> number_used(const std::map<std::string, mesh::GroupCells>& cells, Index nodes) {
  std::vector<Index> number(static_cast<std::size_t>(nodes), -1);
  const auto use = [&](const auto& list) {
    for (const auto& cell : list)
      for (const Index node : cell) number[static_cast<std::size_t>(node)] = 0;
  };
  for (const auto& [name, group] : cells) {
    use(group.segments);
    use(group.triangles);
  }
  Index next = 0;
  for (Index& own : number)
    if (own == 0) own = next++;
  return number;
}

void warn_of_what_is_left(const std::string& file, const mesh::Net& net,
                          const std::vector<std::string>& taken) {
  std::vector<bool> segments(net.surface.segments.size()), triangles(net.surface.triangles.size());
  const auto mark = [](std::vector<bool>& marks, const std::vector<mesh::Index>& cells) {
    for (const mesh::Index cell : cells) marks[static_cast<std::size_t>(cell)] = true;
  };
  for (const auto& set : net.cell_sets)
    if (std::ranges::find(taken, set.name) != taken.end()) {
      mark(segments, set.segments);
      mark(triangles, set.triangles);
    }
  std::vector<std::string> left;
  for (const auto& set : net.cell_sets) {
    const auto is_left = [](const std::vector<bool>& marks) {
      return [&marks](mesh::Index cell) { return !marks[static_cast<std::size_t>(cell)]; };
    };
    const auto count = std::ranges::count_if(set.segments, is_left(segments)) +
                       std::ranges::count_if(set.triangles, is_left(triangles));
    if (count > 0)
      left.push_back(
          fmt::format("{} ({} of {})", set.name, count, set.segments.size() + set.triangles.size()));
  }
  if (!left.empty())
    core::log_warning(
        fmt::format("{}: no part takes elements of these groups: {}", file, fmt::join(left, ", ")));
}

}  // namespace

MeshGroups take_groups(const mesh::MeshFileScene& file, const std::vector<std::string>& groups) {
  const mesh::Net net = mesh::generate(file);
  MeshGroups taken;
  try {
    for (const auto& group : groups) taken.cells[group] = mesh::cells_of_group(net, group);
  } catch (const core::ConfigError& error) {
    throw core::ConfigError(file.path.string() + ": " + error.what());
  }
  warn_of_what_is_left(file.path.string(), net, groups);
  const std::vector<Index> number = number_used(taken.cells, net.surface.node_count());
  const auto renumber = [&](auto& cells) {
    for (auto& cell : cells)
      for (Index& node : cell) node = number[static_cast<std::size_t>(node)];
  };
  for (auto& [name, group] : taken.cells) {
    renumber(group.segments);
    renumber(group.triangles);
  }
  for (std::size_t node = 0; node < number.size(); ++node)
    if (number[node] >= 0)
      taken.positions.insert(taken.positions.end(), &net.surface.positions[3 * node],
                             &net.surface.positions[3 * node] + 3);
  for (const auto& set : net.node_sets) {
    if (set.name == "nodes") continue;  // all of the file, which no part is
    std::vector<Index> nodes;
    for (const Index node : set.nodes)
      if (const Index own = number[static_cast<std::size_t>(node)]; own >= 0) nodes.push_back(own);
    if (!nodes.empty()) taken.node_sets[set.name] = std::move(nodes);
  }
  return taken;
}

}  // namespace talus::fem
