#include "fem_solver/constraints/held_directions.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace talus::fem {
namespace {

bool same_motion(const HeldDirection& one, const HeldDirection& other) {
  return one.displacement == other.displacement &&
         (one.displacement == 0 || one.support->history.points == other.support->history.points);
}

}  // namespace

std::vector<HeldDirection> held_directions(const Model& model) {
  std::vector<HeldDirection> held;
  std::vector<std::size_t> holder(model.reference.size(), 0);  // place in `held` + 1; 0: free
  std::size_t reaction = 0;
  for (const Support& support : model.supports)
    for (const Index node : support.nodes) {
      for (std::size_t c = 0; c < 3; ++c) {
        if (!support.fixed[c]) continue;
        const std::size_t direction = 3 * static_cast<std::size_t>(node) + c;
        const HeldDirection here{direction, reaction + c, &support,
                                 support.displacement[static_cast<int>(c)]};
        if (holder[direction] == 0) {
          held.push_back(here);
          holder[direction] = held.size();
        } else if (const HeldDirection& before = held[holder[direction] - 1]; !same_motion(before, here)) {
          throw core::ConfigError(fmt::format(
              "structure.supports: {} and {} give {} different motions along {}; name it in one of them only",
              before.support->name, support.name, node_name(model, node), "xyz"[c]));
        }
      }
      reaction += 3;
    }
  return held;
}

std::vector<bool> held_nodes(const Model& model) {
  std::vector<int> directions(static_cast<std::size_t>(model.nodes()), 0);
  for (const HeldDirection& h : held_directions(model)) ++directions[h.direction / 3];
  std::vector<bool> held;
  for (const int count : directions) held.push_back(count == 3);
  return held;
}

}  // namespace talus::fem
