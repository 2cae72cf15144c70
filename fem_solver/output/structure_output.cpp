#include "fem_solver/output/structure_output.hpp"

#include <algorithm>
#include <numeric>

#include "fem_solver/output/part_fields.hpp"

namespace talus::fem {
namespace {

constexpr std::size_t displacement_field = 0, velocity_field = 1, first_element_field = 2;

/// Cells by the part's own node numbers.
core::GroupDescription group_of(const Part& part) {
  core::GroupDescription group{.name = part.name,
                               .kind = cell_kind(part.elements),
                               .nodes = std::ssize(part.nodes),
                               .cells = {},
                               .fields = {}};
  const auto local = [&](Index node) {
    return static_cast<std::int64_t>(std::ranges::lower_bound(part.nodes, node) - part.nodes.begin());
  };
  std::visit(
      [&](const auto& batch) {
        for (const auto& cell : batch.cells())
          for (const Index node : cell) group.cells.push_back(local(node));
      },
      part.elements);
  group.fields = {{.name = "displacement", .unit = "m", .components = 3},
                  {.name = "velocity", .unit = "m/s", .components = 3}};
  for (const auto& field : element_fields(part.elements)) group.fields.push_back(field);
  return group;
}

void copy_node_values(const Part& part, std::span<const double> values, std::span<double> out) {
  for (std::size_t i = 0; i < part.nodes.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      out[3 * i + c] = values[3 * static_cast<std::size_t>(part.nodes[i]) + c];
}

}  // namespace

StructureOutput::StructureOutput(const Model& model, Integrator& integrator, const core::OutputScene& scene,
                                 const core::StageClock* clock)
    : model_(model), integrator_(integrator), clock_(clock), probes_(probe_columns(model, scene)) {
  choose_ledger_lines();
  for (const auto& probe : probes_) description_.probes.push_back({probe.name, probe.watches});
  if (clock_) clock_->describe(description_.probes);
  for (const auto& line : ledger_) description_.ledger.push_back(line.description);
  for (const auto& part : model.parts) description_.groups.push_back(group_of(part));
  describe_gravity();
  if (integrator.state().record.empty()) return;
  record_tables_ = ForceRecord(model).tables();
  for (const auto& table : record_tables_)
    description_.tables.push_back({.name = table.name,
                                   .columns = table.columns,
                                   .capacity = std::ssize(table.rows),
                                   .kind = core::TableKind::distribution,
                                   .rows = table.rows});
}

/// A picture of the result needs to know which way is down, and no field holds it: weight over mass of the whole.
void StructureOutput::describe_gravity() {
  if (model_.weight.empty()) return;
  const double mass = std::accumulate(model_.node_masses.begin(), model_.node_masses.end(), 0.0);
  for (std::size_t c = 0; c < 3; ++c) {
    double force = 0;
    for (std::size_t i = c; i < model_.weight.size(); i += 3) force += model_.weight[i];
    description_.facts.push_back({std::string("structure.gravity_") + "xyz"[c] + "_m_per_s2", force / mass});
  }
}

void StructureOutput::choose_ledger_lines() {
  using core::LedgerKind;
  const auto line = [this](const std::string& name, LedgerKind kind, auto value) {
    ledger_.push_back({{"structure." + name + "_J", kind}, value});
  };
  line("kinetic", LedgerKind::stored, &EnergyBalance::kinetic);
  for (std::size_t p = 0; p < model_.parts.size(); ++p)
    line("elastic_" + model_.parts[p].name, LedgerKind::stored,
         [p](const EnergyBalance& b) { return b.elastic[p]; });
  for (std::size_t p = 0; p < model_.parts.size(); ++p)
    if (dissipates(model_.parts[p].elements))
      line("dissipated_" + model_.parts[p].name, LedgerKind::dissipated,
           [p](const EnergyBalance& b) { return b.dissipated[p]; });
  if (!model_.constrained_slides.empty()) line("slides", LedgerKind::dissipated, &EnergyBalance::slides);
  if (!model_.weight.empty()) line("gravity", LedgerKind::stored, &EnergyBalance::gravity);
  if (!model_.damping_rates.empty() || largest_stiffness_damping(model_) > 0)
    line("bulk_damping", LedgerKind::dissipated, &EnergyBalance::bulk_damping);
  if (!model_.loads.empty()) line("loads", LedgerKind::supplied, &EnergyBalance::loads);
  if (std::ranges::any_of(model_.supports, &Support::moves))
    line("moving_supports", LedgerKind::supplied, &EnergyBalance::supports);
  if (!integrator_.interface().nodes().empty())
    line("interface", LedgerKind::supplied, &EnergyBalance::interface);
}

void StructureOutput::fill_probes(std::span<double> values) const {
  for (std::size_t i = 0; i < probes_.size(); ++i) values[i] = probes_[i].value(integrator_);
  if (clock_) std::ranges::copy(clock_->seconds(), values.subspan(probes_.size()).begin());
}

void StructureOutput::fill_ledger(std::span<double> joules) const {
  const EnergyBalance balance = integrator_.balance();
  for (std::size_t i = 0; i < ledger_.size(); ++i) joules[i] = ledger_[i].value(balance);
}

void StructureOutput::fill_table(std::size_t table, std::int64_t first, std::span<double> values) const {
  const ForceRecord::Table& asked = record_tables_[table];
  const std::size_t begin = asked.begin + static_cast<std::size_t>(first) * asked.columns.size();
  std::ranges::copy(std::span(integrator_.state().record).subspan(begin, values.size()), values.begin());
}

void StructureOutput::fill_positions(std::size_t group, std::span<double> positions) const {
  const Part& part = model_.parts[group];
  copy_node_values(part, integrator_.displacement(), positions);
  for (std::size_t i = 0; i < part.nodes.size(); ++i)
    Vector3::Map(&positions[3 * i]) += model_.position(part.nodes[i]);
}

void StructureOutput::fill_field(std::size_t group, std::size_t field, std::span<double> values) const {
  const Part& part = model_.parts[group];
  if (field == displacement_field) return copy_node_values(part, integrator_.displacement(), values);
  if (field == velocity_field) return copy_node_values(part, integrator_.velocity(), values);
  fill_element_field(part.elements, field - first_element_field,
                     configuration_of(model_, part, integrator_.state().configuration()), values);
}

}  // namespace talus::fem
