#pragma once

#include <functional>
#include <vector>

#include "core/output/source.hpp"
#include "core/program/stage_clock.hpp"
#include "core/scene/sections.hpp"
#include "fem_solver/integration/integrator.hpp"
#include "fem_solver/output/probes.hpp"

namespace talus::fem {

/// What the structure offers for output: probes and reactions, the energy ledger, and each part's nodes and
/// elements as a group with displacement, velocity, axial force and stress.
class StructureOutput final : public core::OutputSource {
 public:
  /// @param clock of the stages' times; nullptr: they are not written
  /// @pre model, integrator and clock outlive the output
  StructureOutput(const Model& model, Integrator& integrator, const core::OutputScene& scene,
                  const core::StageClock* clock = nullptr);

  const core::OutputDescription& description() const override { return description_; }
  void fill_probes(std::span<double> values) const override;
  void fill_ledger(std::span<double> joules) const override;
  void fill_positions(std::size_t group, std::span<double> positions) const override;
  void fill_field(std::size_t group, std::size_t field, std::span<double> values) const override;
  std::int64_t table_rows(std::size_t table) const override { return std::ssize(record_tables_[table].rows); }
  void fill_table(std::size_t table, std::int64_t first, std::span<double> values) const override;

 private:
  struct LedgerLine {
    core::LedgerDescription description;
    std::function<double(const EnergyBalance&)> value;
  };
  void describe_gravity();
  void choose_ledger_lines();

  const Model& model_;
  Integrator& integrator_;
  const core::StageClock* clock_;
  std::vector<ProbeColumn> probes_;
  std::vector<LedgerLine> ledger_;
  std::vector<ForceRecord::Table> record_tables_;
  core::OutputDescription description_;
};

}  // namespace talus::fem
