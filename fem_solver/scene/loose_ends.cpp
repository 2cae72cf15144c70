#include "fem_solver/scene/loose_ends.hpp"

#include <fmt/format.h>

#include "core/units/units.hpp"
#include "fem_solver/constraints/held_directions.hpp"
#include "interface_mesh/point_tree.hpp"

namespace talus::fem {
namespace {

constexpr double share_of_element = 0.05;

/// What meets at a node.
struct AtNode {
  int elements = 0;
  Index other = -1;  ///< of the last element with two nodes
};

std::vector<AtNode> elements_at_nodes(const Model& model) {
  std::vector<AtNode> at(static_cast<std::size_t>(model.nodes()));
  const auto meet = [&](Index node, Index other) {
    AtNode& own = at[static_cast<std::size_t>(node)];
    ++own.elements;
    own.other = other;
  };
  for (const Part& part : model.parts) {
    if (std::holds_alternative<ObstacleBatch>(part.elements)) continue;  // stops nodes, joins nothing
    std::visit(
        [&](const auto& batch) {
          for (const auto& cell : batch.cells())
            for (const Index node : cell) meet(node, cell.size() == 2 ? cell[0] + cell[1] - node : -1);
        },
        part.elements);
  }
  for (const auto& slide : model.constrained_slides)
    for (const Index slider : slide.line.sliders) meet(slider, -1);
  return at;
}

}  // namespace

std::vector<std::string> loose_ends(const Model& model) {
  const std::vector<AtNode> at = elements_at_nodes(model);
  const std::vector<bool> held = held_nodes(model);
  std::vector<Index> ends;
  for (Index node = 0; node < model.nodes(); ++node)
    if (const AtNode& own = at[static_cast<std::size_t>(node)];
        own.elements == 1 && own.other >= 0 && !held[static_cast<std::size_t>(node)])
      ends.push_back(node);
  if (ends.empty()) return {};
  const mesh::PointCloud cloud{model.reference};
  mesh::PointTree tree(3, cloud);
  tree.buildIndex();
  std::vector<std::string> found;
  std::vector<std::pair<std::size_t, double>> near;
  for (const Index node : ends) {
    const AtNode& own = at[static_cast<std::size_t>(node)];
    const Vector3 place = model.position(node);
    const double reach = share_of_element * (model.position(own.other) - place).norm();
    tree.radiusSearch(place.data(), reach * reach, near, nanoflann::SearchParams());  // the nearest first
    for (const auto& [other, squared] : near) {
      if (static_cast<Index>(other) == node) continue;
      found.push_back(fmt::format("{} ends {} beside {} and is not joined with it", node_name(model, node),
                                  core::readable(std::sqrt(squared), "m"),
                                  node_name(model, static_cast<Index>(other))));
      break;
    }
  }
  return found;
}

}  // namespace talus::fem
