#include "interface_mesh/mapping.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace talus::mesh {

namespace {

bool are_identical(std::span<const SurfacePoint> ties, Index structure_nodes) {
  bool identical = ties.size() == static_cast<std::size_t>(structure_nodes);
  for (std::size_t node = 0; identical && node < ties.size(); ++node)
    identical = ties[node].count == 1 && ties[node].nodes[0] == static_cast<Index>(node);
  return identical;
}

/// Sum of weighted values of three components.
struct WeightedSum {
  double x = 0, y = 0, z = 0;
  void add(double weight, const double* value) noexcept {
    x += weight * value[0];
    y += weight * value[1];
    z += weight * value[2];
  }
};

template <class T>
std::size_t bytes(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

Mapping::Mapping(std::span<const SurfacePoint> ties, Index structure_nodes)
    : boundary_nodes_(static_cast<Index>(ties.size())),
      structure_nodes_(structure_nodes),
      identity_(are_identical(ties, structure_nodes)),
      to_boundary_(ties),
      to_structure_(ties, structure_nodes) {}

Mapping::PaddedRows::PaddedRows(std::span<const SurfacePoint> ties) {
  for (const auto& tie : ties) width = std::max(width, static_cast<std::size_t>(tie.count));
  sources.reserve(width * ties.size());
  weights.reserve(width * ties.size());
  for (const auto& tie : ties)
    for (std::size_t k = 0; k < width; ++k) {
      const bool padding = k >= static_cast<std::size_t>(tie.count);
      sources.push_back(tie.nodes[padding ? 0 : k]);
      weights.push_back(padding ? 0.0 : tie.weights[k]);
    }
}

Mapping::Rows::Rows(std::span<const SurfacePoint> ties, Index row_count)
    : begin(static_cast<std::size_t>(row_count) + 1, 0) {
  for (const auto& tie : ties)
    for (std::size_t k = 0; k < static_cast<std::size_t>(tie.count); ++k)
      ++begin[static_cast<std::size_t>(tie.nodes[k]) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  sources.resize(static_cast<std::size_t>(begin.back()));
  weights.resize(sources.size());
  auto next = begin;
  for (std::size_t node = 0; node < ties.size(); ++node)
    for (std::size_t k = 0; k < static_cast<std::size_t>(ties[node].count); ++k) {
      const auto place = static_cast<std::size_t>(next[static_cast<std::size_t>(ties[node].nodes[k])]++);
      sources[place] = static_cast<Index>(node);
      weights[place] = ties[node].weights[k];
    }
}

template <std::size_t width>
void Mapping::PaddedRows::gather(std::span<const double> from, std::span<double> to) const noexcept {
  const Index* source = sources.data();
  const double* weight = weights.data();
  for (double* out = to.data(); out != to.data() + to.size(); out += 3, source += width, weight += width) {
    WeightedSum sum;
    for (std::size_t k = 0; k < width; ++k)
      sum.add(weight[k], from.data() + 3 * static_cast<std::ptrdiff_t>(source[k]));
    out[0] = sum.x;
    out[1] = sum.y;
    out[2] = sum.z;
  }
}

void Mapping::Rows::gather(std::span<const double> from, std::span<double> to) const noexcept {
  const auto value = [&](std::ptrdiff_t k) {
    return from.data() + 3 * static_cast<std::ptrdiff_t>(sources[static_cast<std::size_t>(k)]);
  };
  const double* weight = weights.data();
  for (std::size_t row = 0; row + 1 < begin.size(); ++row) {
    // Two sums side by side: rows are long where the structure is coarse, and each addition waits for the one
    // before.
    WeightedSum even, odd;
    std::ptrdiff_t k = begin[row];
    const std::ptrdiff_t end = begin[row + 1];
    for (; k + 1 < end; k += 2) {
      even.add(weight[k], value(k));
      odd.add(weight[k + 1], value(k + 1));
    }
    if (k < end) even.add(weight[k], value(k));
    double* out = to.data() + 3 * row;
    out[0] = even.x + odd.x;
    out[1] = even.y + odd.y;
    out[2] = even.z + odd.z;
  }
}

std::size_t Mapping::bytes_to_boundary() const {
  return identity_ ? 0 : bytes(to_boundary_.sources) + bytes(to_boundary_.weights);
}

std::size_t Mapping::bytes_to_structure() const {
  return identity_ ? 0
                   : bytes(to_structure_.begin) + bytes(to_structure_.sources) + bytes(to_structure_.weights);
}

void Mapping::to_boundary(std::span<const double> structure_motion,
                          std::span<double> boundary_motion) const noexcept {
  assert(structure_motion.size() == 3 * static_cast<std::size_t>(structure_nodes_));
  assert(boundary_motion.size() == 3 * static_cast<std::size_t>(boundary_nodes_));
  if (identity_)
    std::copy(structure_motion.begin(), structure_motion.end(), boundary_motion.begin());
  else if (to_boundary_.width == 1)
    to_boundary_.gather<1>(structure_motion, boundary_motion);
  else if (to_boundary_.width == 2)
    to_boundary_.gather<2>(structure_motion, boundary_motion);
  else
    to_boundary_.gather<3>(structure_motion, boundary_motion);
}

void Mapping::to_structure(std::span<const double> boundary_force,
                           std::span<double> structure_force) const noexcept {
  assert(boundary_force.size() == 3 * static_cast<std::size_t>(boundary_nodes_));
  assert(structure_force.size() == 3 * static_cast<std::size_t>(structure_nodes_));
  if (identity_)
    std::copy(boundary_force.begin(), boundary_force.end(), structure_force.begin());
  else
    to_structure_.gather(boundary_force, structure_force);
}

std::vector<double> Mapping::boundary_masses(std::span<const double> structure_masses) const {
  std::vector<double> masses(static_cast<std::size_t>(boundary_nodes_));
  const std::size_t width = to_boundary_.width;
  for (std::size_t row = 0; row < masses.size(); ++row) {
    double inverse = 0;
    for (std::size_t k = width * row; k < width * (row + 1); ++k) {
      const double weight = to_boundary_.weights[k];
      if (weight != 0)
        inverse += weight * weight / structure_masses[static_cast<std::size_t>(to_boundary_.sources[k])];
    }
    masses[row] = 1 / inverse;
  }
  return masses;
}

}  // namespace talus::mesh
