#include "fem_solver/scene/unheld_parts.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <span>

namespace talus::fem {
namespace {

/// Nodes that hang together: each points to another of its piece, the last to itself.
class Pieces {
 public:
  explicit Pieces(Index nodes) : towards_(static_cast<std::size_t>(nodes)) {
    std::iota(towards_.begin(), towards_.end(), 0);
  }
  Index of(Index node) {
    auto& next = towards_[static_cast<std::size_t>(node)];
    while (next != towards_[static_cast<std::size_t>(next)]) next = towards_[static_cast<std::size_t>(next)];
    return next;
  }
  void join(std::span<const Index> nodes) {
    for (const Index node : nodes) towards_[static_cast<std::size_t>(of(node))] = of(nodes.front());
  }

 private:
  std::vector<Index> towards_;
};

void join_line(const SlideLine& line, Pieces& pieces) {
  pieces.join(line.rope);
  pieces.join(line.sliders);
  if (!line.rope.empty() && !line.sliders.empty())
    pieces.join(std::array{line.rope.front(), line.sliders.front()});
}

}  // namespace

std::vector<std::vector<std::string>> unheld_parts(const Model& model) {
  Pieces pieces(model.nodes());
  for (const Part& part : model.parts)
    std::visit(
        [&](const auto& batch) {
          for (const auto& cell : batch.cells()) pieces.join(cell);
          if constexpr (requires { batch.line().sliders; }) join_line(batch.line(), pieces);
        },
        part.elements);
  for (const auto& slide : model.constrained_slides) join_line(slide.line, pieces);

  std::vector<Index> held;
  for (const Support& support : model.supports)
    for (const Index node : support.nodes) held.push_back(pieces.of(node));
  std::map<Index, std::vector<std::string>> names;
  for (const Part& part : model.parts)
    for (const Index node : part.nodes) {
      auto& piece = names[pieces.of(node)];
      if (piece.empty() || piece.back() != part.name) piece.push_back(part.name);
    }
  std::vector<std::vector<std::string>> unheld;
  for (auto& [piece, parts] : names)
    if (std::ranges::find(held, piece) == held.end()) unheld.push_back(std::move(parts));
  return unheld;
}

}  // namespace talus::fem
