#include "fem_solver/scene/masses.hpp"

#include <algorithm>

#include "fem_solver/constraints/held_directions.hpp"

namespace talus::fem {
namespace {

const PartScene* scene_of(const StructureScene& scene, const Part& part) {
  const auto found =
      std::ranges::find(scene.parts, part.scene_part, [](const auto& entry) { return entry.first; });
  return found == scene.parts.end() ? nullptr : &found->second;  // slides are parts that no scene has
}

/// kg; what parts weigh at each node, of those that `chosen` takes.
template <class Chosen>
std::vector<double> masses_of_parts(const Model& model, const Chosen& chosen) {
  std::vector<double> masses(static_cast<std::size_t>(model.nodes()), 0.0);
  for (const Part& part : model.parts)
    if (chosen(part)) std::visit([&](const auto& batch) { batch.add_mass(masses); }, part.elements);
  return masses;
}

void add_weight(std::span<const double> masses, const Vector3& gravity, std::vector<double>& weight) {
  weight.resize(3 * masses.size(), 0.0);
  for (std::size_t node = 0; node < masses.size(); ++node)
    for (std::size_t c = 0; c < 3; ++c) weight[3 * node + c] += masses[node] * gravity[static_cast<int>(c)];
}

void weigh(const StructureScene& scene, std::span<const double> point_masses, Model& model) {
  const auto own = [&](const Part& part) -> const std::optional<core::Vector3>* {
    const PartScene* written = scene_of(scene, part);
    return written && written->gravity ? &written->gravity : nullptr;
  };
  if (scene.gravity) {
    std::vector<double> masses = masses_of_parts(model, [&](const Part& part) { return !own(part); });
    for (std::size_t node = 0; node < masses.size(); ++node) masses[node] += point_masses[node];
    add_weight(masses, *scene.gravity, model.weight);
  }
  for (const Part& part : model.parts)
    if (const auto* gravity = own(part))
      add_weight(masses_of_parts(model, [&](const Part& other) { return &other == &part; }), **gravity,
                 model.weight);
}

void damp(const StructureScene& scene, std::span<const double> point_masses, Model& model) {
  const DampingScene of_all = scene.damping.value_or(DampingScene{});
  const auto of = [&](const Part& part) {
    const PartScene* written = scene_of(scene, part);
    return written && written->damping ? *written->damping : of_all;
  };
  for (Part& part : model.parts) part.stiffness_damping = of(part).stiffness;
  const bool same =
      std::ranges::all_of(model.parts, [&](const Part& p) { return of(p).mass == of_all.mass; });
  if (same) {
    if (of_all.mass > 0) model.damping_rates.assign(static_cast<std::size_t>(model.nodes()), of_all.mass);
    return;
  }
  std::vector<double> force(point_masses.size()), mass(point_masses.begin(), point_masses.end());
  for (std::size_t node = 0; node < force.size(); ++node) force[node] = of_all.mass * point_masses[node];
  for (const Part& part : model.parts) {
    const auto own = masses_of_parts(model, [&](const Part& other) { return &other == &part; });
    for (std::size_t node = 0; node < own.size(); ++node) {
      force[node] += of(part).mass * own[node];
      mass[node] += own[node];
    }
  }
  for (std::size_t node = 0; node < force.size(); ++node)
    model.damping_rates.push_back(mass[node] > 0 ? force[node] / mass[node] : 0);
}

}  // namespace

void weigh_and_damp(const StructureScene& scene, std::span<const double> point_masses, Model& model) {
  weigh(scene, point_masses, model);
  damp(scene, point_masses, model);
}

void let_held_bars_turn(Model& model) {
  const std::vector<bool> held = held_nodes(model);
  const auto place = [](Index node) { return static_cast<std::size_t>(node); };
  for (const Part& part : model.parts) {
    const auto* bars = std::get_if<BarBatch>(&part.elements);
    if (!bars) continue;
    std::vector<int> uses(held.size(), 0);
    for (const auto& bar : bars->cells())
      for (const Index node : bar) ++uses[place(node)];
    for (Index e = 0; e < bars->size(); ++e) {
      const auto [a, b] = bars->cells()[place(e)];
      if (held[place(a)] == held[place(b)]) continue;
      const Index foot = held[place(a)] ? a : b, head = held[place(a)] ? b : a;
      if (uses[place(head)] > 1) continue;
      const double mass = bars->part().density * bars->part().section.area * bars->reference_length(e);
      model.node_masses[place(head)] -= mass / 6;
      model.node_masses[place(foot)] += mass / 6;
    }
  }
}

}  // namespace talus::fem
