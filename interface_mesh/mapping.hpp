#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/vector3.hpp"
#include "interface_mesh/feature_tree.hpp"
#include "interface_mesh/surface.hpp"

namespace talus::mesh {

/// Carries motion from the structure Ω_S to the boundary Ω_D and forces back. Row i of W holds the weights
/// with which boundary node i hangs on structure nodes.
///
///     motion, consistent:      u_D = W u_S       v_D = W v_S
///     force, conservative:     f_S = W^T f_D
///
/// | symbol | variable  | meaning                        | unit   |
/// |--------|-----------|--------------------------------|--------|
/// | u, v   | motion    | displacement or velocity, 3 a node | m, m/s |
/// | f      | force     | nodal forces, 3 a node         | N      |
/// | W      | weights   | linear weights, row sum 1      | 1      |
///
/// Therefore f_S . u_S = f_D . u_D for any motion (virtual work), and the total force is kept because each
/// row sums to 1. The total moment is kept too where the tied points coincide; `transfer_error` measures what
/// the offsets cost. Tests: "virtual work ...", "total force ...", "total moment ..." in mapping_test.cpp.
///
/// Both directions gather in a fixed order from flat arrays: no allocation, the same bits on every run.
class Mapping {
 public:
  /// One tie a boundary node. @pre node indices below structure_nodes
  Mapping(std::span<const SurfacePoint> ties, Index structure_nodes);

  /// @pre sizes 3 structure_nodes() and 3 boundary_nodes(); the spans do not overlap
  void to_boundary(std::span<const double> structure_motion,
                   std::span<double> boundary_motion) const noexcept;
  void to_structure(std::span<const double> boundary_force, std::span<double> structure_force) const noexcept;

  /// The mass that answers a force on boundary node i at once, 1/m_i = sum_k w_k^2 / m_k over its masters
  /// (kg): the acceleration of the tied point under a force on it, divided by that force. 0 where a master
  /// has no mass.
  std::vector<double> boundary_masses(std::span<const double> structure_masses) const;

  /// Boundary node i is structure node i, for all: both sides may use the same arrays.
  bool is_identity() const { return identity_; }
  Index boundary_nodes() const { return boundary_nodes_; }
  Index structure_nodes() const { return structure_nodes_; }
  /// Bytes of the arrays that one transfer in each direction reads.
  std::size_t bytes_to_boundary() const;
  std::size_t bytes_to_structure() const;

 private:
  /// W: every row padded to the same number of masters by weights of 0, so that the loop over a row has a
  /// fixed length (a third faster than rows of any length).
  struct PaddedRows {
    std::size_t width = 1;  ///< masters a row, 1 to 3
    std::vector<Index> sources;
    std::vector<double> weights;

    explicit PaddedRows(std::span<const SurfacePoint> ties);
    template <std::size_t width>
    void gather(std::span<const double> from, std::span<double> to) const noexcept;
  };
  /// W^T: row i gathers weights[k] times value sources[k], k from begin[i] to begin[i + 1].
  struct Rows {
    std::vector<Index> begin, sources;
    std::vector<double> weights;

    Rows(std::span<const SurfacePoint> ties, Index row_count);
    void gather(std::span<const double> from, std::span<double> to) const noexcept;
  };

  Index boundary_nodes_ = 0, structure_nodes_ = 0;
  bool identity_ = false;
  PaddedRows to_boundary_;
  Rows to_structure_;
};

/// A mapping and how well its two surfaces lie on each other.
struct TiedSurfaces {
  Mapping mapping;
  double tolerance = 0;         ///< m; the largest distance that was allowed
  double largest_distance = 0;  ///< m; of a boundary node from the point it is tied to
  Index farthest_node = 0;      ///< the boundary node of the largest distance
};

/// The tolerance where none is given: this part of the diagonal of the structure's bounding box.
inline constexpr double default_tolerance_of_extent = 0.01;

/// Ties each boundary node, at the reference state, to the nearest triangle, segment or lone node of the
/// structure. `tolerance` (m): a boundary node farther from the structure is orphaned.
/// @throws core::ConfigError naming orphaned nodes with coordinates and distance, or a structure without
/// nodes.
TiedSurfaces tie_to_nearest_feature(const Surface& boundary, const Surface& structure,
                                    std::optional<double> tolerance = std::nullopt);

/// Ties each boundary node to the nearest structure node alone: exact on identical meshes, loses the moment
/// and linear fields on others. Errors as above.
TiedSurfaces tie_to_nearest_node(const Surface& boundary, const Surface& structure,
                                 std::optional<double> tolerance = std::nullopt);

/// What a transfer of forces changes: totals on the structure minus totals on the boundary, and what to
/// compare them with.
struct TransferError {
  core::Vector3 force;        ///< N
  core::Vector3 moment;       ///< N m; about the origin, of the forces at the reference positions
  double largest_force = 0;   ///< N; of one boundary node
  double largest_moment = 0;  ///< N m
};
/// @pre boundary_force.size() == boundary.positions.size()
TransferError transfer_error(const Mapping& mapping, const Surface& boundary, const Surface& structure,
                             std::span<const double> boundary_force);

}  // namespace talus::mesh
