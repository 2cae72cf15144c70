#pragma once

#include <string>

#include "fem_solver/materials/axial_laws.hpp"
#include "fem_solver/model/rope_batch.hpp"

namespace talus::fem {

/// A sliding cable without friction that breaks. Its tension is the same everywhere, and once it is broken anywhere
/// nothing holds it: the first step that ends beyond a limit is the last one in which it pulls. What it stored is
/// dissipated then. It remembers one number, as Breaking (axial_laws.hpp) has it: minus what it has dissipated, once it
/// is broken.
/// @see ElementBatch for the meaning of the members.
class BreakingRopeBatch {
 public:
  /// @param limits strain and work are of the whole rope
  BreakingRopeBatch(SlidingCableBatch rope, const BreakingLimits& limits)
      : rope_(std::move(rope)), limits_(limits) {}

  static std::string called() { return "breaking " + SlidingCableBatch::called(); }
  Index size() const { return 1; }
  Index slots() const { return rope_.slots(); }
  const std::vector<std::array<Index, 2>>& cells() const { return rope_.cells(); }
  template <class Visit>
  void for_each_incidence(const Visit& visit) const {
    rope_.for_each_incidence(visit);
  }

  std::size_t memory_size() const { return 1; }
  void fill_initial_memory(std::span<double> memory) const { memory.front() = 0; }

  void internal_force(const Configuration& at, std::span<double> next, std::span<double> slots,
                      core::Block elements) const noexcept;
  void stiffness_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                         core::Block elements) const noexcept;
  void stiffest_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                        core::Block elements) const noexcept;
  void add_stiffness_bound(const Configuration& at, std::span<double> row_sums) const {
    if (!is_broken(at)) rope_.add_stiffness_bound(at, row_sums);
  }
  double energy(const Configuration& at) const noexcept {
    return is_broken(at) ? slack_energy() : rope_.energy(at);
  }
  double dissipated(const Configuration& at) const noexcept { return is_broken(at) ? -at.memory.front() : 0; }
  void add_mass(std::span<double> node_masses) const noexcept { rope_.add_mass(node_masses); }
  template <class Sink>
  void stiffness(const Configuration& at, const Sink& sink) const {
    const bool broken = is_broken(at);
    rope_.stiffness(at, [&](Index row, Index column, const Matrix3& block) {
      sink(row, column, broken ? Matrix3(Matrix3::Zero()) : block);
    });
  }

  /// The rope is one element.
  bool is_broken(const Configuration& at, Index = 0) const noexcept {
    return !at.memory.empty() && at.memory.front() < 0;
  }
  double axial_force(const Configuration& at, Index = 0) const noexcept {
    return is_broken(at) ? 0 : rope_.tension(at);
  }
  double elongation(const Configuration& at) const noexcept {
    return rope_.length(at) - rope_.line().reference_length();
  }
  const RopeLine& line() const { return rope_.line(); }

 private:
  /// Stored where it hangs slack (J).
  double slack_energy() const noexcept;

  SlidingCableBatch rope_;
  BreakingLimits limits_;
};

}  // namespace talus::fem
