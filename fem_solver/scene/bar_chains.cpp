#include "fem_solver/scene/bar_chains.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"
#include "fem_solver/constraints/held_directions.hpp"

namespace talus::fem {
namespace {

/// What meets at each node.
struct Meeting {
  std::vector<int> bars;    ///< without prestress
  std::vector<bool> other;  ///< whatever else may hold it
};

Meeting meeting_of(const Model& model) {
  const auto nodes = static_cast<std::size_t>(model.nodes());
  Meeting meeting{std::vector<int>(nodes, 0), std::vector<bool>(nodes, false)};
  for (const Part& part : model.parts) {
    const auto* bars = std::get_if<BarBatch>(&part.elements);
    if (bars && !(bars->part().section.prestress > 0)) {
      for (const auto& bar : bars->cells())
        for (const Index node : bar) ++meeting.bars[static_cast<std::size_t>(node)];
    } else if (!std::holds_alternative<ObstacleBatch>(part.elements)) {
      for (const Index node : part.nodes) meeting.other[static_cast<std::size_t>(node)] = true;
    }
  }
  for (const HeldDirection& h : held_directions(model)) meeting.other[h.direction / 3] = true;
  for (const auto& slide : model.constrained_slides)
    for (const auto* list : {&slide.line.rope, &slide.line.sliders})
      for (const Index node : *list) meeting.other[static_cast<std::size_t>(node)] = true;
  return meeting;
}

}  // namespace

void refuse_folding_chains(const Model& model) {
  const Meeting meeting = meeting_of(model);
  for (Index node = 0; node < model.nodes(); ++node) {
    const auto k = static_cast<std::size_t>(node);
    if (meeting.bars[k] != 2 || meeting.other[k]) continue;
    throw core::ConfigError(
        fmt::format("structure: two bars without prestress meet at {} and nothing else holds it: bars turn "
                    "freely at their ends, "
                    "so the chain folds up; take one bar from end to end, or a third element at this node",
                    node_name(model, node)));
  }
}

}  // namespace talus::fem
