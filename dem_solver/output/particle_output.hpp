#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/output/source.hpp"
#include "dem_solver/output/gate_tables.hpp"
#include "dem_solver/solver.hpp"

namespace talus::dem {

/// What gets columns in probes.csv, with its number in the solver.
struct NamedBodies {
  std::vector<std::pair<std::string, Index>> spheres, rocks;
  std::vector<core::Fact> facts = {};  ///< of their shapes
};

/// What a run of particles writes: the trajectory of each named sphere and rock, the ledger, the tables
/// of the gates, and fields of all particles, of the rocks' surfaces and of the boundary.
class ParticleOutput : public core::OutputSource {
 public:
  /// @param rock_surfaces one a rock, in its principal axes; empty ones are not drawn
  /// @param clock of the stages' times; nullptr: they are not written
  /// @pre solver and clock outlive this
  ParticleOutput(const ParticleSolver& solver, NamedBodies named, std::vector<mesh::Surface> rock_surfaces,
                 const core::StageClock* clock = nullptr);

  const core::OutputDescription& description() const override { return description_; }
  void fill_probes(std::span<double> values) const override;
  void fill_ledger(std::span<double> joules) const override;
  void fill_positions(std::size_t group, std::span<double> positions) const override;
  void fill_field(std::size_t group, std::size_t field, std::span<double> values) const override;
  std::int64_t table_rows(std::size_t table) const override { return gates_.rows(table); }
  void fill_table(std::size_t table, std::int64_t first, std::span<double> values) const override {
    gates_.fill(table, first, values);
  }

 private:
  enum class Group { particles, rocks, wires, faces };
  void describe_probes();
  void describe_ledger();
  void describe_particles();
  void describe_rocks();
  void describe_boundary();
  void fill_rock_surfaces(std::span<double> positions) const;

  const ParticleSolver& solver_;
  NamedBodies named_;
  std::vector<mesh::Surface> rock_surfaces_;
  GateTables gates_;
  const core::StageClock* clock_;
  core::OutputDescription description_;
  std::vector<Group> groups_;
};

}  // namespace talus::dem
