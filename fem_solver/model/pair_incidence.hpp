#pragma once

#include <array>
#include <span>

#include "fem_solver/elements/axial.hpp"
#include "fem_solver/model/index.hpp"

namespace talus::fem {

/// Every segment pulls its farther node with + and its nearer node with - its force slot: visit(node, slot,
/// sign).
template <class Visit>
void for_each_pair_incidence(std::span<const std::array<Index, 2>> segments, const Visit& visit) {
  Index slot = 0;
  for (const auto& [near, far] : segments) {
    visit(near, slot, -1);
    visit(far, slot, +1);
    ++slot;
  }
}

/// From the derivative of one segment's force by another's chord to blocks by nodes: sink(row node, column
/// node, block).
template <class Sink>
void spread_pair_block(const std::array<Index, 2>& row, const std::array<Index, 2>& column,
                       const Matrix3& block, const Sink& sink) {
  const Matrix3 negated = -block;
  sink(row[0], column[0], block);
  sink(row[0], column[1], negated);
  sink(row[1], column[0], negated);
  sink(row[1], column[1], block);
}

/// Adds the sizes of the rows of the blocks K and -K that two nodes share (N/m).
inline void add_pair_bound(const std::array<Index, 2>& nodes, const Matrix3& K,
                           std::span<double> row_sums) noexcept {
  for (const Index node : nodes)
    Vector3::Map(&row_sums[3 * static_cast<std::size_t>(node)]) += 2 * K.cwiseAbs().rowwise().sum();
}

}  // namespace talus::fem
