#include "interface_mesh/files/cell_collector.hpp"

#include <algorithm>
#include <numeric>

#include "interface_mesh/points.hpp"

namespace talus::mesh {

namespace {

std::string name_of(const std::vector<Listing>& groups) {
  std::string name;
  for (const auto& listing : groups) name += (name.empty() ? "" : " + ") + listing.group;
  return name;
}

/// The indices of cells, those of one part behind each other.
template <class Cells>
std::vector<std::size_t> by_part(const Cells& cells) {
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return cells[a].part < cells[b].part; });
  return order;
}

}  // namespace

void CellCollector::list_in(const std::vector<Listing>& groups) {
  listings_ = groups;
  part_ = no_part;
}

/// Parts are made by their first cell: a group without cells makes none.
std::size_t CellCollector::part_now() {
  if (part_ != no_part) return part_;
  const auto [found, is_new] = part_of_.emplace(listings_, parts_.size());
  if (is_new) parts_.push_back(listings_);
  return part_ = found->second;
}

void CellCollector::add_line(std::array<Index, 2> nodes) {
  if (!listings_.empty() && listings_.front().turned) std::swap(nodes[0], nodes[1]);
  lines_.push_back({part_now(), nodes});
}

void CellCollector::add_triangle(std::array<Index, 3> nodes) {
  if (!listings_.empty() && listings_.front().turned) std::swap(nodes[1], nodes[2]);
  triangles_.push_back({part_now(), nodes});
}

void CellCollector::add_to_node_set(const std::string& name, Index node) {
  auto& members = in_node_set_[name];
  if (members.empty()) node_sets_.push_back({name, {}});
  if (!members.insert(node).second) return;
  std::find_if(node_sets_.begin(), node_sets_.end(), [&](const NodeSet& set) {
    return set.name == name;
  })->nodes.push_back(node);
}

void CellCollector::add_cells(Net& net) const {
  Surface& surface = net.surface;
  for (const auto& groups : parts_) surface.parts.push_back({.name = name_of(groups)});
  const auto add = [&](const auto& cells, auto& to, Index SurfacePart::*begin, Index SurfacePart::*end) {
    for (const std::size_t k : by_part(cells)) {
      SurfacePart& part = surface.parts[cells[k].part];
      if (part.*end == 0) part.*begin = static_cast<Index>(to.size());
      to.push_back(cells[k].nodes);
      part.*end = static_cast<Index>(to.size());
    }
    // A part without such cells is an empty run where the part before it ends.
    Index last = 0;
    for (SurfacePart& part : surface.parts) {
      if (part.*end == 0) part.*begin = part.*end = last;
      last = part.*end;
    }
  };
  add(lines_, surface.segments, &SurfacePart::segment_begin, &SurfacePart::segment_end);
  add(triangles_, surface.triangles, &SurfacePart::triangle_begin, &SurfacePart::triangle_end);
}

void CellCollector::add_cell_sets(Net& net) const {
  std::map<std::string, std::size_t> place;
  for (std::size_t k = 0; k < parts_.size(); ++k)
    for (const Listing& listing : parts_[k]) {
      const auto [found, is_new] = place.emplace(listing.group, net.cell_sets.size());
      if (is_new) net.cell_sets.push_back({.name = listing.group});
      CellSet& set = net.cell_sets[found->second];
      const SurfacePart& part = net.surface.parts[k];
      for (Index i = part.segment_begin; i < part.segment_end; ++i) set.segments.push_back(i);
      for (Index i = part.triangle_begin; i < part.triangle_end; ++i) {
        if (listing.turned != parts_[k].front().turned) set.turned.push_back(i);
        set.triangles.push_back(i);
      }
    }
}

/// New numbers of the nodes that stay, -1 for the others.
std::vector<Index> CellCollector::used_nodes(std::size_t count) const {
  std::vector<Index> number(count, -1);
  const auto mark = [&number](Index node) { number[static_cast<std::size_t>(node)] = 0; };
  for (const auto& line : lines_) std::for_each(line.nodes.begin(), line.nodes.end(), mark);
  for (const auto& triangle : triangles_) std::for_each(triangle.nodes.begin(), triangle.nodes.end(), mark);
  for (const auto& set : node_sets_) std::for_each(set.nodes.begin(), set.nodes.end(), mark);
  Index next = 0;
  for (Index& each : number)
    if (each == 0) each = next++;
  return number;
}

Net CellCollector::net(const std::vector<double>& positions) const {
  Net net;
  add_cells(net);
  add_cell_sets(net);
  const std::vector<Index> number = used_nodes(positions.size() / 3);
  const auto renumber = [&number](Index& node) { node = number[static_cast<std::size_t>(node)]; };
  for (auto& segment : net.surface.segments) std::for_each(segment.begin(), segment.end(), renumber);
  for (auto& triangle : net.surface.triangles) std::for_each(triangle.begin(), triangle.end(), renumber);
  for (Index node = 0; node < static_cast<Index>(number.size()); ++node)
    if (number[static_cast<std::size_t>(node)] >= 0) append(net.surface.positions, point(positions, node));
  net.node_sets.push_back({"nodes", std::vector<Index>(static_cast<std::size_t>(net.surface.node_count()))});
  std::iota(net.node_sets[0].nodes.begin(), net.node_sets[0].nodes.end(), Index{0});
  for (NodeSet set : node_sets_) {
    std::for_each(set.nodes.begin(), set.nodes.end(), renumber);
    net.node_sets.push_back(std::move(set));
  }
  return net;
}

}  // namespace talus::mesh
