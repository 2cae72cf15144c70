#include "fem_solver/output/probes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.hpp"
#include "core/program/log.hpp"
#include "core/units/units.hpp"
#include "fem_solver/output/part_fields.hpp"
#include "fem_solver/output/watched_node.hpp"

namespace talus::fem {
namespace {

const Part& find_part(const Model& model, const std::string& probe, const std::string& name) {
  const auto found = std::ranges::find(model.parts, name, &Part::name);
  if (found == model.parts.end())
    throw core::ConfigError(fmt::format("output.probes.{}: the structure has no part '{}'", probe, name));
  return *found;
}

/// Where rounded coordinates or a node a little to the side are meant, the result says which node it is; a point
/// further away than any element there reaches was meant to be elsewhere.
WatchedNode node_of_probe(const Model& model, const std::string& probe, const Vector3& point,
                          const Part* part) {
  const WatchedNode watched = watched_node(model, part, point);
  if (watched.distance > watched.reach)
    throw core::ConfigError(
        fmt::format("output.probes.{}.at: no node is near: {}; the longest element there has {}", probe,
                    description(model, watched), core::readable(watched.reach, "m")));
  constexpr double rounded = 1e-3;  // of the element: coordinates as they are written
  if (watched.distance > rounded * watched.reach)
    core::log_info(fmt::format("probe {} watches {}", probe, description(model, watched)));
  return watched;
}

using Values = std::vector<double> State::*;

/// x, y, z and the magnitude of a vector per node.
void add_vector(std::vector<ProbeColumn>& columns, const std::string& name, const char* unit, Values values,
                Index node) {
  const auto at = static_cast<std::size_t>(3 * node);
  for (std::size_t c = 0; c < 3; ++c)
    columns.push_back({fmt::format("{}_{}_{}", name, "xyz"[c], unit),
                       [=](const Integrator& run) { return (run.state().*values)[at + c]; },
                       {}});
  columns.push_back({fmt::format("{}_{}", name, unit),
                     [=](const Integrator& run) { return Vector3::Map(&(run.state().*values)[at]).norm(); }});
}

void add_part_columns(std::vector<ProbeColumn>& columns, const std::string& probe, const Model& model,
                      const Part& part) {
  const std::vector<const char*> names = part_quantities(part.elements);
  for (std::size_t i = 0; i < names.size(); ++i)
    columns.push_back({fmt::format("{}.{}", probe, names[i]), [&model, &part, i](const Integrator& run) {
                         return part_quantity(part.elements, i,
                                              configuration_of(model, part, run.state().configuration()));
                       }});
}

void add_reactions(std::vector<ProbeColumn>& columns, const Model& model) {
  std::size_t begin = 0;
  for (const auto& support : model.supports) {
    const std::size_t end = begin + support.nodes.size();
    for (std::size_t c = 0; c < 3; ++c) {
      if (!support.fixed[c]) continue;
      columns.push_back({fmt::format("{}.reaction_{}_N", support.name, "xyz"[c]), [=](const Integrator& run) {
                           double sum = 0;
                           for (std::size_t k = begin; k < end; ++k) sum += run.reactions()[3 * k + c];
                           return sum;
                         }});
    }
    begin = end;
  }
}

void add_slide_gaps(std::vector<ProbeColumn>& columns, const Model& model) {
  for (std::size_t k = 0; k < model.constrained_slides.size(); ++k)
    columns.push_back({model.constrained_slides[k].name + ".gap_max_m",
                       [k](const Integrator& run) { return run.slide_gap(k); }});
}

/// Keeps the columns whose quantity (the name between the dot and the unit) is asked for.
void keep_quantities(std::vector<ProbeColumn>& columns, const std::string& probe,
                     const std::vector<std::string>& wanted) {
  const auto has = [&](const ProbeColumn& column, const std::string& quantity) {
    return column.name.starts_with(probe + "." + quantity + "_") &&
           column.name.find('_', probe.size() + quantity.size() + 2) == std::string::npos;
  };
  const auto matches = [&](const ProbeColumn& column, const std::string& quantity) {
    return has(column, quantity) || column.name == probe + "." + quantity + "_m_per_s";
  };
  for (const auto& quantity : wanted)
    if (std::ranges::none_of(columns, [&](const auto& column) { return matches(column, quantity); }))
      throw core::ConfigError(
          fmt::format("output.probes.{}.quantities: '{}' is not known for this probe", probe, quantity));
  std::erase_if(columns, [&](const auto& column) {
    return std::ranges::none_of(wanted, [&](const auto& quantity) { return matches(column, quantity); });
  });
}

}  // namespace

std::vector<ProbeColumn> probe_columns(const Model& model, const core::OutputScene& output) {
  std::vector<ProbeColumn> all;
  for (const auto& [name, probe] : output.probes) {
    if (probe.rock) continue;
    std::vector<ProbeColumn> columns;
    const Part* part = probe.part ? &find_part(model, name, *probe.part) : nullptr;
    if (probe.at) {
      const WatchedNode watched = node_of_probe(model, name, *probe.at, part);
      add_vector(columns, name + ".displacement", "m", &State::displacement, watched.node);
      add_vector(columns, name + ".velocity", "m_per_s", &State::velocity, watched.node);
      for (ProbeColumn& column : columns) column.watches = description(model, watched);
    } else {
      add_part_columns(columns, name, model, *part);
    }
    if (!probe.quantities.empty()) keep_quantities(columns, name, probe.quantities);
    all.insert(all.end(), columns.begin(), columns.end());
  }
  add_reactions(all, model);
  add_slide_gaps(all, model);
  return all;
}

}  // namespace talus::fem
