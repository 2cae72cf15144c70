#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "core/errors.hpp"
#include "interface_mesh/mapping.hpp"
#include "interface_mesh/points.hpp"

namespace talus::mesh {

namespace {

constexpr std::size_t most_orphans_written = 10;

double default_tolerance(const Surface& structure) {
  core::Vector3 low = point(structure.positions, 0), high = low;
  for (Index node = 1; node < structure.node_count(); ++node) {
    low = low.cwiseMin(point(structure.positions, node));
    high = high.cwiseMax(point(structure.positions, node));
  }
  return default_tolerance_of_extent * (high - low).norm();
}

void refuse_orphans(const Surface& boundary, const std::vector<SurfacePoint>& ties, double tolerance) {
  std::vector<core::Complaint> complaints;
  std::size_t orphans = 0;
  for (std::size_t node = 0; node < ties.size(); ++node) {
    if (ties[node].distance <= tolerance || ++orphans > most_orphans_written) continue;
    complaints.push_back(
        {.file = {},
         .line = 0,
         .column = 0,
         .key_path = "interface",
         .message = fmt::format(
             "boundary node {} at {} is {:g} m away from the structure, more than the tolerance of {:g} m",
             node, describe_point(point(boundary.positions, static_cast<Index>(node))), ties[node].distance,
             tolerance)});
  }
  if (orphans == 0) return;
  if (orphans > most_orphans_written)
    complaints.push_back({.file = {},
                          .line = 0,
                          .column = 0,
                          .key_path = "interface",
                          .message = fmt::format("... and {} more boundary nodes like these",
                                                 orphans - most_orphans_written)});
  throw core::ConfigError(std::move(complaints));
}

TiedSurfaces tie(const Surface& boundary, const FeatureTree& tree, Index structure_nodes, double tolerance) {
  std::vector<SurfacePoint> ties(static_cast<std::size_t>(boundary.node_count()));
  for (Index node = 0; node < boundary.node_count(); ++node)
    ties[static_cast<std::size_t>(node)] = tree.nearest(point(boundary.positions, node));
  refuse_orphans(boundary, ties, tolerance);
  TiedSurfaces result{.mapping = Mapping(ties, structure_nodes), .tolerance = tolerance};
  for (std::size_t node = 0; node < ties.size(); ++node)
    if (ties[node].distance > result.largest_distance) {
      result.largest_distance = ties[node].distance;
      result.farthest_node = static_cast<Index>(node);
    }
  return result;
}

void require_nodes(const Surface& structure) {
  if (structure.node_count() == 0)
    throw core::ConfigError("interface: the structure has no nodes to tie the boundary to");
}

}  // namespace

TiedSurfaces tie_to_nearest_feature(const Surface& boundary, const Surface& structure,
                                    std::optional<double> tolerance) {
  require_nodes(structure);
  return tie(boundary, FeatureTree::of_features(structure), structure.node_count(),
             tolerance.value_or(default_tolerance(structure)));
}

TiedSurfaces tie_to_nearest_node(const Surface& boundary, const Surface& structure,
                                 std::optional<double> tolerance) {
  require_nodes(structure);
  return tie(boundary, FeatureTree::of_nodes(structure), structure.node_count(),
             tolerance.value_or(default_tolerance(structure)));
}

TransferError transfer_error(const Mapping& mapping, const Surface& boundary, const Surface& structure,
                             std::span<const double> boundary_force) {
  std::vector<double> structure_force(structure.positions.size());
  mapping.to_structure(boundary_force, structure_force);
  TransferError error{.force = core::Vector3::Zero(), .moment = core::Vector3::Zero()};
  for (Index node = 0; node < structure.node_count(); ++node) {
    const core::Vector3 force = point(structure_force, node);
    error.force += force;
    error.moment += point(structure.positions, node).cross(force);
  }
  for (Index node = 0; node < boundary.node_count(); ++node) {
    const core::Vector3 force = point(boundary_force, node);
    const core::Vector3 moment = point(boundary.positions, node).cross(force);
    error.force -= force;
    error.moment -= moment;
    error.largest_force = std::max(error.largest_force, force.norm());
    error.largest_moment = std::max(error.largest_moment, moment.norm());
  }
  return error;
}

}  // namespace talus::mesh
