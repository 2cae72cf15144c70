#include "fem_solver/integration/external_force.hpp"

#include "core/parallel.hpp"

namespace talus::fem {

void add_external_force(const Model& model, const InterfaceForce& interface, const LoadTime& when,
                        std::span<double> force) noexcept {
  if (!model.weight.empty()) {
    const double factor = load_factor(model.gravity_history, when);
    core::parallel_for(static_cast<std::int64_t>(force.size()),
                       [&](std::int64_t i) { force[i] += factor * model.weight[i]; });
  }
  for (const auto& load : model.loads) {
    const Vector3 nodal = load_factor(load.history, when) * load.force;
    for (const Index node : load.nodes) Vector3::Map(&force[3 * node]) += nodal;
  }
  interface.for_each([&](Index node, const auto& on_node) { Vector3::Map(&force[3 * node]) += on_node; });
}

void add_works(const Model& model, const InterfaceForce& interface, const LoadSpan& span,
               std::span<const double> change, ExternalWorks& works) noexcept {
  const auto move_of = [&](Index node) { return Vector3::Map(&change[3 * static_cast<std::size_t>(node)]); };
  if (!model.weight.empty()) {
    const double factor = 0.5 * (load_factor(model.gravity_history, span.before) +
                                 load_factor(model.gravity_history, span.after));
    for (std::size_t i = 0; i < change.size(); ++i) works.gravity += factor * model.weight[i] * change[i];
  }
  for (const auto& load : model.loads) {
    const double factor =
        0.5 * (load_factor(load.history, span.before) + load_factor(load.history, span.after));
    for (const Index node : load.nodes) works.loads += factor * load.force.dot(move_of(node));
  }
  interface.for_each([&](Index node, const auto& on_node) { works.interface += on_node.dot(move_of(node)); });
}

void place_supports(std::span<const HeldDirection> held, const LoadTime& when,
                    std::span<double> displacement) noexcept {
  for (const HeldDirection& h : held)
    displacement[h.direction] = load_factor(h.support->history, when) * h.displacement;
}

void archive(core::StateArchive& archive, ExternalWorks& works) {
  std::vector<double> numbers{works.gravity, works.loads, works.interface, works.supports};
  archive.values("works", numbers);
  works = {numbers[0], numbers[1], numbers[2], numbers[3]};
}

std::size_t reaction_count(const Model& model) {
  std::size_t count = 0;
  for (const auto& support : model.supports) count += 3 * support.nodes.size();
  return count;
}

}  // namespace talus::fem
