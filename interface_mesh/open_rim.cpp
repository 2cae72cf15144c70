#include "interface_mesh/open_rim.hpp"

namespace talus::mesh {

namespace {

constexpr Index inside = -1;

/// The place of every node on the rim, in the rim's order.
std::vector<Index> places_on_rim(const Net& net) {
  std::vector<Index> place(static_cast<std::size_t>(net.surface.node_count()), inside);
  const auto& rim = net.find_set("rim")->nodes;
  for (std::size_t k = 0; k < rim.size(); ++k)
    place[static_cast<std::size_t>(rim[k])] = static_cast<Index>(k);
  return place;
}

std::vector<std::array<Index, 2>> inner_segments(const Net& net) {
  const std::vector<Index> place = places_on_rim(net);
  const auto around = static_cast<Index>(net.find_set("rim")->nodes.size());
  std::vector<std::array<Index, 2>> kept;
  for (const auto& [a, b] : net.surface.segments) {
    const Index from = place[static_cast<std::size_t>(a)], to = place[static_cast<std::size_t>(b)];
    const bool on_rim =
        from != inside && to != inside && ((from + 1) % around == to || (to + 1) % around == from);
    if (!on_rim) kept.push_back({a, b});
  }
  return kept;
}

}  // namespace

Net without_rim_wires(const Net& net) {
  Net open;
  Surface& surface = open.surface;
  surface.segments = inner_segments(net);
  surface.parts = net.surface.parts;
  surface.parts.front().segment_end = static_cast<Index>(surface.segments.size());
  std::vector<Index> number(static_cast<std::size_t>(net.surface.node_count()), -1);
  for (const auto& segment : surface.segments)
    for (const Index node : segment) number[static_cast<std::size_t>(node)] = 0;
  Index next = 0;
  for (std::size_t node = 0; node < number.size(); ++node) {
    if (number[node] < 0) continue;
    number[node] = next++;
    const auto* x = &net.surface.positions[3 * node];
    surface.positions.insert(surface.positions.end(), x, x + 3);
  }
  for (auto& segment : surface.segments)
    for (Index& node : segment) node = number[static_cast<std::size_t>(node)];
  for (const auto& set : net.node_sets) {
    NodeSet left{set.name, {}};
    for (const Index node : set.nodes)
      if (number[static_cast<std::size_t>(node)] >= 0)
        left.nodes.push_back(number[static_cast<std::size_t>(node)]);
    if (!left.nodes.empty()) open.node_sets.push_back(left);
  }
  return open;
}

}  // namespace talus::mesh
