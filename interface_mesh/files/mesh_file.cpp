#include "interface_mesh/files/mesh_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>

#include "core/errors.hpp"
#include "interface_mesh/files/gmsh.hpp"
#include "interface_mesh/files/surface_readers.hpp"
#include "interface_mesh/files/surface_writers.hpp"
#include "interface_mesh/points.hpp"

namespace talus::mesh {

namespace {

/// Lower-case, without the dot.
std::string kind_of(const std::filesystem::path& path) {
  std::string kind = path.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return kind.empty() ? kind : kind.substr(1);
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw core::ConfigError(fmt::format("{}: {}", path.string(), reason));
}

void require_known_kind(const std::filesystem::path& path) {
  const auto kind = kind_of(path);
  if (kind != "msh" && kind != "stl" && kind != "obj" && kind != "ply")
    refuse(path, "is no mesh file: its name must end in .msh, .stl, .obj or .ply");
}

}  // namespace

Net read_mesh_file(const std::filesystem::path& path) {
  require_known_kind(path);
  if (!std::filesystem::is_regular_file(path)) refuse(path, "is no file");
  const std::string kind = kind_of(path);
  if (kind == "msh") return read_gmsh(path);
  const auto read = kind == "stl" ? read_stl : kind == "obj" ? read_obj : read_ply;
  return read(Scanner::open(path));
}

void write_mesh_file(const Net& net, const std::filesystem::path& path) {
  require_known_kind(path);
  const std::string kind = kind_of(path);
  if (kind == "msh") return write_gmsh(net, path);
  if (!net.surface.segments.empty() || net.surface.triangles.empty())
    refuse(path, fmt::format(".{} files take triangles only, but the mesh has {} lines and {} triangles",
                             kind, net.surface.segments.size(), net.surface.triangles.size()));
  std::ofstream out(path);
  const auto write = kind == "stl" ? write_stl : kind == "obj" ? write_obj : write_ply;
  write(out, net.surface);
  out.close();
  if (!out) refuse(path, "cannot be written");
}

GroupCells cells_of_group(const Net& net, const std::string& group) {
  const auto& sets = net.cell_sets;
  const auto set = std::find_if(sets.begin(), sets.end(), [&](const CellSet& s) { return s.name == group; });
  if (set == sets.end()) {
    std::vector<std::string> names;
    for (const auto& each : sets) names.push_back(each.name);
    throw core::ConfigError(fmt::format(
        "there is no part '{}' in the mesh; there {}", group,
        names.empty() ? "are none: leave `part` out" : fmt::format("are: {}", fmt::join(names, ", "))));
  }
  GroupCells cells;
  for (const Index k : set->segments)
    cells.segments.push_back(net.surface.segments[static_cast<std::size_t>(k)]);
  for (const Index k : set->triangles) {
    auto triangle = net.surface.triangles[static_cast<std::size_t>(k)];
    if (std::binary_search(set->turned.begin(), set->turned.end(), k)) std::swap(triangle[1], triangle[2]);
    cells.triangles.push_back(triangle);
  }
  return cells;
}

Net extract_part(const Net& net, const std::string& name) {
  const GroupCells cells = cells_of_group(net, name);
  Net result;
  std::vector<Index> new_index(static_cast<std::size_t>(net.surface.node_count()), -1);
  const auto carry = [&](auto cell) {
    for (Index& node : cell) {
      Index& carried = new_index[static_cast<std::size_t>(node)];
      if (carried < 0) {
        carried = result.surface.node_count();
        append(result.surface.positions, point(net.surface.positions, node));
      }
      node = carried;
    }
    return cell;
  };
  for (const auto& segment : cells.segments) result.surface.segments.push_back(carry(segment));
  for (const auto& triangle : cells.triangles) result.surface.triangles.push_back(carry(triangle));
  result.surface.parts.push_back({.name = name,
                                  .segment_end = static_cast<Index>(result.surface.segments.size()),
                                  .triangle_end = static_cast<Index>(result.surface.triangles.size())});
  for (const auto& nodes : net.node_sets) {
    NodeSet cut{nodes.name, {}};
    for (const Index node : nodes.nodes)
      if (new_index[static_cast<std::size_t>(node)] >= 0)
        cut.nodes.push_back(new_index[static_cast<std::size_t>(node)]);
    if (!cut.nodes.empty()) result.node_sets.push_back(std::move(cut));
  }
  return result;
}

}  // namespace talus::mesh
