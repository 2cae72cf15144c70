#include "fem_solver/scene/unheld_parts.hpp"

#include <algorithm>
#include <map>
#include <span>

#include "fem_solver/model/joined_nodes.hpp"

namespace talus::fem {
namespace {

void join_all(std::span<const Index> nodes, JoinedNodes& pieces) {
  for (const Index node : nodes) pieces.join(node, nodes.front());
}

void join_line(const SlideLine& line, JoinedNodes& pieces) {
  join_all(line.rope, pieces);
  for (const Index slider : line.sliders) pieces.join(slider, line.rope.front());
}

}  // namespace

std::vector<std::vector<std::string>> unheld_parts(const Model& model) {
  JoinedNodes pieces(static_cast<std::size_t>(model.nodes()));
  for (const Part& part : model.parts)
    std::visit(
        [&](const auto& batch) {
          for (const auto& cell : batch.cells()) join_all(cell, pieces);
          if constexpr (requires { batch.line().sliders; }) join_line(batch.line(), pieces);
        },
        part.elements);
  for (const auto& slide : model.constrained_slides) join_line(slide.line, pieces);

  std::vector<Index> held;
  for (const Part& part : model.parts)
    if (std::holds_alternative<ObstacleBatch>(part.elements))
      for (const Index node : part.nodes) held.push_back(pieces.of(node));
  for (const Support& support : model.supports)
    for (const Index node : support.nodes) held.push_back(pieces.of(node));
  std::map<Index, std::vector<std::string>> names;
  for (const Part& part : model.parts) {
    if (std::holds_alternative<ObstacleBatch>(part.elements)) continue;
    for (const Index node : part.nodes) {
      auto& piece = names[pieces.of(node)];
      if (piece.empty() || piece.back() != part.name) piece.push_back(part.name);
    }
  }
  std::vector<std::vector<std::string>> unheld;
  for (auto& [piece, parts] : names)
    if (std::ranges::find(held, piece) == held.end()) unheld.push_back(std::move(parts));
  return unheld;
}

}  // namespace talus::fem
