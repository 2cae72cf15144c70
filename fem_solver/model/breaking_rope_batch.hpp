#pragma once

#include <string>
#include <utility>

#include "fem_solver/materials/axial_laws.hpp"
#include "fem_solver/model/frictional_cable_batch.hpp"
#include "fem_solver/model/rope_batch.hpp"

namespace talus::fem {

/// A rope through many nodes, with friction or without, that breaks: once it is broken anywhere nothing holds it. The
/// first step that ends beyond a limit is the last one in which it pulls. What it stored is dissipated then. Behind
/// what the rope itself remembers it has one number, as Breaking (axial_laws.hpp) has it: minus what it has
/// dissipated on the whole, once it is broken.
/// @see ElementBatch for the meaning of the members.
template <class Rope>
class BreakingRope {
 public:
  /// @param limits strain and work are of the whole rope, the force that of its tautest segment
  BreakingRope(Rope rope, const BreakingLimits& limits) : rope_(std::move(rope)), limits_(limits) {}

  static std::string called() { return "breaking " + Rope::called(); }
  Index size() const { return 1; }
  Index slots() const { return rope_.slots(); }
  const std::vector<std::array<Index, 2>>& cells() const { return rope_.cells(); }
  template <class Visit>
  void for_each_incidence(const Visit& visit) const {
    rope_.for_each_incidence(visit);
  }

  std::size_t memory_size() const { return own_memory() + 1; }
  void fill_initial_memory(std::span<double> memory) const {
    if constexpr (Remembers<Rope>) rope_.fill_initial_memory(memory.first(own_memory()));
    memory.back() = 0;
  }

  void internal_force(const Configuration& at, std::span<double> next, std::span<double> slots,
                      core::Block elements) const noexcept;
  void stiffness_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                         core::Block elements) const noexcept;
  void stiffest_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                        core::Block elements) const noexcept;
  void damping_product(const Configuration& at, std::span<const double> velocity, std::span<double> slots,
                       core::Block elements) const noexcept;
  void add_stiffness_bound(const Configuration& at, std::span<double> row_sums) const {
    if (!is_broken(at)) rope_.add_stiffness_bound(own(at), row_sums);
  }
  double energy(const Configuration& at) const noexcept {
    return is_broken(at) ? slack_energy() : rope_.energy(own(at));
  }
  double dissipated(const Configuration& at) const noexcept;
  void add_mass(std::span<double> node_masses) const noexcept { rope_.add_mass(node_masses); }
  template <class Sink>
  void stiffness(const Configuration& at, const Sink& sink) const {
    rope_.stiffness(own(at), none_if(is_broken(at), sink));
  }
  template <class Sink>
  void damping_matrix(const Configuration& at, const Sink& sink) const {
    rope_.damping_matrix(own(at), none_if(is_broken(at), sink));
  }

  /// The rope is one element.
  bool is_broken(const Configuration& at, Index = 0) const noexcept {
    return !at.memory.empty() && at.memory.back() < 0;
  }
  /// Of its tautest segment (N).
  double axial_force(const Configuration& at, Index = 0) const noexcept {
    return is_broken(at) ? 0 : largest_tension(own(at));
  }
  double tension_of(const Configuration& at, Index segment) const noexcept;
  double elongation(const Configuration& at) const noexcept {
    return rope_.length(own(at)) - rope_.line().reference_length();
  }
  const RopeLine& line() const { return rope_.line(); }
  const Rope& rope() const { return rope_; }
  /// The configuration as the rope itself knows it.
  Configuration own(const Configuration& at) const noexcept {
    return {at.displacement, at.memory.empty() ? at.memory : at.memory.first(own_memory())};
  }

 private:
  std::size_t own_memory() const noexcept {
    if constexpr (Remembers<Rope>)
      return rope_.memory_size();
    else
      return 0;
  }
  double largest_tension(const Configuration& own) const noexcept;
  /// Stored where it hangs slack (J).
  double slack_energy() const noexcept;
  template <class Sink>
  static auto none_if(bool broken, const Sink& sink) {
    return [broken, &sink](Index row, Index column, const Matrix3& block) {
      sink(row, column, broken ? Matrix3(Matrix3::Zero()) : block);
    };
  }

  Rope rope_;
  BreakingLimits limits_;
};

using BreakingRopeBatch = BreakingRope<SlidingCableBatch>;
using BreakingFrictionalCableBatch = BreakingRope<FrictionalCableBatch>;
extern template class BreakingRope<SlidingCableBatch>;
extern template class BreakingRope<FrictionalCableBatch>;

}  // namespace talus::fem
