#include "fem_solver/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus::fem {

double TimeTable::at(double time) const {
  if (points.empty()) return 1;
  if (time <= points.front().first) return points.front().second;
  const auto next = std::upper_bound(points.begin(), points.end(), time,
                                     [](double t, const auto& point) { return t < point.first; });
  if (next == points.end()) return points.back().second;
  const auto& [t0, f0] = *(next - 1);
  const auto& [t1, f1] = *next;
  return f0 + (f1 - f0) * (time - t0) / (t1 - t0);
}

double TimeTable::rate_after(double time) const {
  const auto next = std::upper_bound(points.begin(), points.end(), time,
                                     [](double t, const auto& point) { return t < point.first; });
  if (next == points.begin() || next == points.end()) return 0;
  return (next->second - (next - 1)->second) / (next->first - (next - 1)->first);
}

std::vector<double> initial_memory(const Model& model) {
  std::vector<double> memory;
  for (const auto& part : model.parts)
    std::visit(
        [&](const auto& batch) {
          if constexpr (Remembers<std::decay_t<decltype(batch)>>) {
            memory.resize(memory.size() + batch.memory_size());
            batch.fill_initial_memory(std::span(memory).last(batch.memory_size()));
          }
        },
        part.elements);
  return memory;
}

bool dissipates(const ElementBatch& elements) {
  return std::visit([](const auto& batch) { return Remembers<std::decay_t<decltype(batch)>>; }, elements);
}

Configuration configuration_of(const Model& model, const Part& part, const Configuration& at) {
  Configuration found = at;
  const auto number = static_cast<std::size_t>(&part - model.parts.data());
  for_each_part(model, at, [&](std::size_t p, const auto&, const Configuration& own) {
    if (p == number) found = own;
  });
  return found;
}

std::vector<double> elastic_by_parts(const Model& model, const Configuration& at) {
  std::vector<double> joules;
  for_each_part(model, at, [&](std::size_t, const auto& batch, const Configuration& own) {
    joules.push_back(batch.energy(own));
  });
  return joules;
}

std::vector<double> dissipated_by_parts(const Model& model, const Configuration& at) {
  std::vector<double> joules(model.parts.size(), 0.0);
  for_each_part(model, at, [&](std::size_t p, const auto& batch, const Configuration& own) {
    if constexpr (Remembers<std::decay_t<decltype(batch)>>) joules[p] = batch.dissipated(own);
  });
  return joules;
}

std::vector<double> stiffness_bounds(const Model& model, const Configuration& at) {
  std::vector<double> sums(model.reference.size(), 0.0);
  for_each_part(model, at, [&](std::size_t, const auto& batch, const Configuration& own) {
    batch.add_stiffness_bound(own, sums);
  });
  return sums;
}

void lump_masses(Model& model) {
  model.node_masses.assign(static_cast<std::size_t>(model.nodes()), 0.0);
  for (const auto& part : model.parts)
    std::visit([&](const auto& batch) { batch.add_mass(model.node_masses); }, part.elements);
}

void weigh(Model& model, const Vector3& gravity) {
  model.weight.clear();
  for (const double mass : model.node_masses)
    for (const double g : gravity) model.weight.push_back(mass * g);
}

void damp_by_stiffness(Model& model, double seconds) {
  for (Part& part : model.parts) part.stiffness_damping = seconds;
}

double largest_stiffness_damping(const Model& model) {
  double largest = 0;
  for (const Part& part : model.parts) largest = std::max(largest, part.stiffness_damping);
  return largest;
}

std::string node_name(const Model& model, Index node) {
  const Vector3 x = model.position(node);
  const auto owner = std::find_if(model.parts.begin(), model.parts.end(), [node](const Part& part) {
    return std::binary_search(part.nodes.begin(), part.nodes.end(), node);
  });
  const std::string of = owner == model.parts.end() ? "" : " of " + owner->name;
  return fmt::format("node {}{} at ({:.6g}, {:.6g}, {:.6g}) m", node, of, x.x(), x.y(), x.z());
}

}  // namespace talus::fem
