#include "interface_mesh/mapping.hpp"

#include <algorithm>
#include <cassert>

namespace talus::mesh {

Mapping::Mapping(std::span<const SurfacePoint> ties, Index structure_nodes)
    : boundary_nodes_(static_cast<Index>(ties.size())), structure_nodes_(structure_nodes) {
  Rows& rows = to_boundary_;
  rows.begin.reserve(ties.size() + 1);
  rows.begin.push_back(0);
  for (const auto& tie : ties) {
    rows.sources.insert(rows.sources.end(), tie.nodes.begin(), tie.nodes.begin() + tie.count);
    rows.weights.insert(rows.weights.end(), tie.weights.begin(), tie.weights.begin() + tie.count);
    rows.begin.push_back(static_cast<Index>(rows.sources.size()));
  }
  to_structure_ = to_boundary_.transposed(structure_nodes_);
  to_boundary_.look_for_identity(structure_nodes_);
  to_structure_.look_for_identity(boundary_nodes_);
}

Mapping::Rows Mapping::Rows::transposed(Index columns) const {
  Rows result;
  result.begin.assign(static_cast<std::size_t>(columns) + 1, 0);
  result.sources.resize(sources.size());
  result.weights.resize(weights.size());
  for (const Index source : sources) ++result.begin[static_cast<std::size_t>(source) + 1];
  for (std::size_t column = 0; column < static_cast<std::size_t>(columns); ++column)
    result.begin[column + 1] += result.begin[column];
  auto next = result.begin;
  for (std::size_t row = 0; row + 1 < begin.size(); ++row)
    for (auto k = static_cast<std::size_t>(begin[row]); k < static_cast<std::size_t>(begin[row + 1]); ++k) {
      const auto place = static_cast<std::size_t>(next[static_cast<std::size_t>(sources[k])]++);
      result.sources[place] = static_cast<Index>(row);
      result.weights[place] = weights[k];
    }
  return result;
}

void Mapping::Rows::look_for_identity(Index columns) {
  const auto rows = begin.size() - 1;
  identity = rows == static_cast<std::size_t>(columns) && sources.size() == rows;
  for (std::size_t row = 0; identity && row < rows; ++row)
    identity =
        begin[row] == static_cast<Index>(row) && sources[row] == static_cast<Index>(row) && weights[row] == 1;
}

std::size_t Mapping::Rows::bytes() const {
  if (identity) return 0;
  return (begin.size() + sources.size()) * sizeof(Index) + weights.size() * sizeof(double);
}

void Mapping::Rows::gather(std::span<const double> from, std::span<double> to) const noexcept {
  if (identity) {
    std::copy(from.begin(), from.end(), to.begin());
    return;
  }
  const double* value = from.data();
  const double* weight = weights.data();
  const Index* source = sources.data();
  const auto rows = static_cast<std::ptrdiff_t>(begin.size()) - 1;
  for (std::ptrdiff_t row = 0; row < rows; ++row) {
    double x = 0, y = 0, z = 0;
    const std::ptrdiff_t end = begin[static_cast<std::size_t>(row) + 1];
    for (std::ptrdiff_t k = begin[static_cast<std::size_t>(row)]; k < end; ++k) {
      const double* of_source = value + 3 * static_cast<std::ptrdiff_t>(source[k]);
      x += weight[k] * of_source[0];
      y += weight[k] * of_source[1];
      z += weight[k] * of_source[2];
    }
    double* out = to.data() + 3 * row;
    out[0] = x;
    out[1] = y;
    out[2] = z;
  }
}

void Mapping::to_boundary(std::span<const double> structure_motion,
                          std::span<double> boundary_motion) const noexcept {
  assert(structure_motion.size() == 3 * static_cast<std::size_t>(structure_nodes_));
  assert(boundary_motion.size() == 3 * static_cast<std::size_t>(boundary_nodes_));
  to_boundary_.gather(structure_motion, boundary_motion);
}

void Mapping::to_structure(std::span<const double> boundary_force,
                           std::span<double> structure_force) const noexcept {
  assert(boundary_force.size() == 3 * static_cast<std::size_t>(boundary_nodes_));
  assert(structure_force.size() == 3 * static_cast<std::size_t>(structure_nodes_));
  to_structure_.gather(boundary_force, structure_force);
}

std::vector<double> Mapping::boundary_masses(std::span<const double> structure_masses) const {
  std::vector<double> masses(static_cast<std::size_t>(boundary_nodes_));
  for (std::size_t row = 0; row < masses.size(); ++row) {
    double inverse = 0;
    for (auto k = static_cast<std::size_t>(to_boundary_.begin[row]);
         k < static_cast<std::size_t>(to_boundary_.begin[row + 1]); ++k) {
      const double weight = to_boundary_.weights[k];
      inverse += weight * weight / structure_masses[static_cast<std::size_t>(to_boundary_.sources[k])];
    }
    masses[row] = 1 / inverse;
  }
  return masses;
}

}  // namespace talus::mesh
