#include <fmt/format.h>
#include <fmt/ostream.h>

#include <fstream>

#include "core/errors.hpp"
#include "interface_mesh/files/gmsh.hpp"
#include "interface_mesh/points.hpp"

namespace talus::mesh {

namespace {

/// A physical group and the one geometric entity that carries it.
struct Group {
  int dimension = 0, tag = 0;
  std::string name;
  std::size_t cells = 0;
};

std::vector<Group> groups_of(const Net& net) {
  std::vector<Group> groups;
  const auto add = [&](int dimension, const std::string& name, std::size_t cells) {
    if (cells > 0) groups.push_back({dimension, static_cast<int>(groups.size()) + 1, name, cells});
  };
  for (const auto& set : net.node_sets)
    if (set.name != "nodes") add(0, set.name, set.nodes.size());
  for (const auto& part : net.surface.parts)
    add(1, part.name, static_cast<std::size_t>(part.segment_end - part.segment_begin));
  for (const auto& part : net.surface.parts)
    add(2, part.name, static_cast<std::size_t>(part.triangle_end - part.triangle_begin));
  return groups;
}

void write_header(std::ostream& out, const std::vector<Group>& groups) {
  fmt::print(out, "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", groups.size());
  for (const auto& group : groups) fmt::print(out, "{} {} \"{}\"\n", group.dimension, group.tag, group.name);
  std::array<std::size_t, 3> counts{};
  for (const auto& group : groups) ++counts[static_cast<std::size_t>(group.dimension)];
  fmt::print(out, "$EndPhysicalNames\n$Entities\n{} {} {} 0\n", counts[0], counts[1], counts[2]);
  for (const auto& group : groups)
    fmt::print(out, "{} {} 1 {}{}\n", group.tag, group.dimension == 0 ? "0 0 0" : "0 0 0 0 0 0", group.tag,
               group.dimension == 0 ? "" : " 0");
  fmt::print(out, "$EndEntities\n");
}

void write_nodes(std::ostream& out, const Surface& surface, const Group& owner) {
  const Index count = surface.node_count();
  fmt::print(out, "$Nodes\n1 {0} 1 {0}\n{1} {2} 0 {0}\n", count, owner.dimension, owner.tag);
  for (Index node = 1; node <= count; ++node) fmt::print(out, "{}\n", node);
  // The shortest digits that read back as the same number.
  for (Index node = 0; node < count; ++node) {
    const auto at = point(surface.positions, node);
    fmt::print(out, "{} {} {}\n", at.x(), at.y(), at.z());
  }
  fmt::print(out, "$EndNodes\n");
}

/// Writes the elements of one group, numbered on from `element`.
template <class Cells>
void write_block(std::ostream& out, const Group& group, const Cells& cells, std::size_t& element) {
  constexpr std::array kinds{15, 1, 2};
  fmt::print(out, "{} {} {} {}\n", group.dimension, group.tag,
             kinds[static_cast<std::size_t>(group.dimension)], group.cells);
  for (const auto& cell : cells) {
    fmt::print(out, "{}", ++element);
    for (const Index node : cell) fmt::print(out, " {}", node + 1);
    fmt::print(out, "\n");
  }
}

void write_elements(std::ostream& out, const Net& net, const std::vector<Group>& groups) {
  std::size_t total = 0, element = 0;
  for (const auto& group : groups) total += group.cells;
  fmt::print(out, "$Elements\n{} {} 1 {}\n", groups.size(), total, total);
  auto group = groups.begin();
  for (const auto& set : net.node_sets) {
    if (set.name == "nodes" || set.nodes.empty()) continue;
    std::vector<std::array<Index, 1>> points;
    for (const Index node : set.nodes) points.push_back({node});
    write_block(out, *group++, points, element);
  }
  const auto write_range = [&](const auto& cells, Index begin, Index end) {
    if (begin < end)
      write_block(out, *group++, std::vector(cells.begin() + begin, cells.begin() + end), element);
  };
  for (const auto& part : net.surface.parts)
    write_range(net.surface.segments, part.segment_begin, part.segment_end);
  for (const auto& part : net.surface.parts)
    write_range(net.surface.triangles, part.triangle_begin, part.triangle_end);
  fmt::print(out, "$EndElements\n");
}

}  // namespace

void write_gmsh(const Net& net, const std::filesystem::path& path) {
  std::ofstream out(path);
  const auto groups = groups_of(net);
  if (groups.empty()) throw core::ConfigError("a mesh without cells cannot be written");
  write_header(out, groups);
  write_nodes(out, net.surface, groups.back());
  write_elements(out, net, groups);
  out.close();
  if (!out) throw core::ConfigError(fmt::format("{}: cannot be written", path.string()));
}

}  // namespace talus::mesh
