#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/output/source.hpp"
#include "dem_solver/solver.hpp"

namespace talus::dem {

/// What a run of particles writes: the trajectory of each named sphere, the ledger, and fields of all
/// particles and of the boundary.
class ParticleOutput : public core::OutputSource {
 public:
  /// @param named name and number of the spheres that get columns in probes.csv. @pre the solver outlives
  /// this
  ParticleOutput(const ParticleSolver& solver, std::vector<std::pair<std::string, Index>> named);

  const core::OutputDescription& description() const override { return description_; }
  void fill_probes(std::span<double> values) const override;
  void fill_ledger(std::span<double> joules) const override;
  void fill_positions(std::size_t group, std::span<double> positions) const override;
  void fill_field(std::size_t group, std::size_t field, std::span<double> values) const override;

 private:
  enum class Group { particles, wires, faces };
  void describe_probes();
  void describe_ledger();
  void describe_particles();
  void describe_boundary();

  const ParticleSolver& solver_;
  std::vector<std::pair<std::string, Index>> named_;
  core::OutputDescription description_;
  std::vector<Group> groups_;
};

}  // namespace talus::dem
