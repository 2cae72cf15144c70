#pragma once

#include <span>
#include <vector>

#include "core/output/source.hpp"
#include "dem_solver/solver.hpp"

namespace talus::dem {

/// What the gates write beside their columns: of each gate, the stones in the order they passed, and how many
/// of each size passed and were held.
class GateTables {
 public:
  /// @pre the solver outlives this
  explicit GateTables(const ParticleSolver& solver);

  std::vector<core::TableDescription> descriptions() const;
  std::int64_t rows(std::size_t table) const;
  void fill(std::size_t table, std::int64_t first, std::span<double> values) const;

  /// Spheres that are no part of a rock, and rocks.
  std::int64_t stones() const noexcept { return static_cast<std::int64_t>(stones_.size()); }

 private:
  struct Stone {
    Index number = 0;  ///< a sphere's id or a rock's number
    bool is_rock = false;
    std::size_t size = 0;  ///< index in sieves_
  };
  static void fill_passages(std::span<const Passage> passages, std::span<double> values);
  void fill_sizes(std::size_t gate, std::span<double> values) const;

  const ParticleSolver& solver_;
  std::vector<Stone> stones_;
  std::vector<int> sieves_;  ///< those that hold a stone, ascending
};

}  // namespace talus::dem
