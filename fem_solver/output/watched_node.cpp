#include "fem_solver/output/watched_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "core/units/units.hpp"

namespace talus::fem {
namespace {

double longest_element_at(const Model& model, const Part& part, Index node) {
  double longest = 0;
  std::visit(
      [&](const auto& batch) {
        for (const auto& cell : batch.cells()) {
          if (std::ranges::find(cell, node) == std::end(cell)) continue;
          for (const Index other : cell)
            longest = std::max(longest, (model.position(other) - model.position(node)).norm());
        }
      },
      part.elements);
  return longest;
}

}  // namespace

WatchedNode watched_node(const Model& model, const Part* part, const Vector3& point) {
  const auto distance = [&](Index node) { return (model.position(node) - point).norm(); };
  WatchedNode watched{.node = part ? part->nodes.front() : 0};
  watched.distance = distance(watched.node);
  const auto consider = [&](Index node) {
    if (const double own = distance(node); own < watched.distance) watched = {node, own, 0};
  };
  if (part)
    std::ranges::for_each(part->nodes, consider);
  else
    for (Index node = 0; node < model.nodes(); ++node) consider(node);
  for (const Part& one : model.parts)
    if (!part || part == &one)
      watched.reach = std::max(watched.reach, longest_element_at(model, one, watched.node));
  return watched;
}

std::string description(const Model& model, const WatchedNode& watched) {
  return fmt::format("{}, {} from the point asked for", node_name(model, watched.node),
                     core::readable(watched.distance, "m"));
}

}  // namespace talus::fem
