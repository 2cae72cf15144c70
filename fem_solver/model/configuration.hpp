#pragma once

#include <span>

namespace talus::fem {

/// The state that elements are asked at: where the nodes are, and what the elements remember of the steps
/// accepted so far. Elements answer for it and change nothing.
struct Configuration {
  std::span<const double> displacement;  ///< m, 3 a node
  /// What Model::initial_memory() began: of all parts, or of one part where its batch is asked. Empty: as the
  /// elements were made.
  std::span<const double> memory;

  template <class Values>
  requires std::convertible_to<const Values&, std::span<const double>> Configuration(const Values& of_nodes)
      : displacement(of_nodes) {}
  Configuration(std::span<const double> of_nodes, std::span<const double> of_elements)
      : displacement(of_nodes), memory(of_elements) {}
};

/// Batches whose elements remember: friction, brakes, plasticity. Besides what every batch has (model.hpp):
///   memory_size(), fill_initial_memory(span)       how much, and what it is before the first step
///   internal_force(at, next, slots, range)         fills `next` with the memory if this state is accepted
///   dissipated(at)                                 J, up to the memory given
template <class Batch>
concept Remembers = requires(const Batch& batch) {
  batch.memory_size();
};

}  // namespace talus::fem
