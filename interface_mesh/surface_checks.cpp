#include "interface_mesh/surface_checks.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/errors.hpp"
#include "interface_mesh/points.hpp"

namespace talus::mesh {

std::string describe_point(const core::Vector3& point) {
  return fmt::format("({:g}, {:g}, {:g}) m", point.x(), point.y(), point.z());
}

namespace {

constexpr std::size_t most_written = 10;
constexpr double shortest_of_extent = 1e-12;
constexpr double flattest_of_edge = 1e-10;

/// Collects the sentences of one kind of fault.
class Sentences {
 public:
  explicit Sentences(std::vector<std::string>& all) : all_(all) {}
  ~Sentences() {
    if (count_ > most_written)
      all_.push_back(fmt::format("... and {} more of this kind", count_ - most_written));
  }
  Sentences(const Sentences&) = delete;
  Sentences& operator=(const Sentences&) = delete;

  void add(std::string sentence) {
    if (++count_ <= most_written) all_.push_back(std::move(sentence));
  }
  bool empty() const { return count_ == 0; }

 private:
  std::vector<std::string>& all_;
  std::size_t count_ = 0;
};

bool find_bad_positions(const Surface& surface, std::vector<std::string>& all) {
  Sentences found(all);
  if (surface.positions.size() % 3 != 0)
    found.add(fmt::format("has {} coordinates, which is no multiple of 3", surface.positions.size()));
  for (Index node = 0; node < surface.node_count(); ++node)
    if (const auto at = point(surface.positions, node); !at.allFinite())
      found.add(fmt::format("node {} at {} is not finite", node, describe_point(at)));
  return !found.empty();
}

template <class Cells>
void find_bad_indices(const Cells& cells, Index node_count, const char* kind, Sentences& found) {
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
    for (const Index node : cells[cell])
      if (node < 0 || node >= node_count)
        found.add(fmt::format("{} {} names node {}, but there are {} nodes", kind, cell, node, node_count));
}

void find_bad_parts(const Surface& surface, Sentences& found) {
  const auto wrong = [](Index begin, Index end, std::size_t size) {
    return begin < 0 || end < begin || end > static_cast<Index>(size);
  };
  for (const auto& part : surface.parts)
    if (wrong(part.segment_begin, part.segment_end, surface.segments.size()) ||
        wrong(part.triangle_begin, part.triangle_end, surface.triangles.size()))
      found.add(fmt::format("part '{}' reaches outside the surface's cells", part.name));
}

bool find_bad_references(const Surface& surface, std::vector<std::string>& all) {
  Sentences found(all);
  find_bad_indices(surface.segments, surface.node_count(), "segment", found);
  find_bad_indices(surface.triangles, surface.node_count(), "triangle", found);
  find_bad_parts(surface, found);
  return !found.empty();
}

double extent(const Surface& surface) {
  if (surface.positions.empty()) return 0;
  core::Vector3 low = point(surface.positions, 0), high = low;
  for (Index node = 1; node < surface.node_count(); ++node) {
    low = low.cwiseMin(point(surface.positions, node));
    high = high.cwiseMax(point(surface.positions, node));
  }
  return (high - low).norm();
}

void find_short_segments(const Surface& surface, std::vector<std::string>& all) {
  Sentences found(all);
  const double shortest = shortest_of_extent * extent(surface);
  for (std::size_t i = 0; i < surface.segments.size(); ++i) {
    const auto [a, b] = surface.segments[i];
    const core::Vector3 start = point(surface.positions, a);
    if ((point(surface.positions, b) - start).norm() <= shortest)
      found.add(
          fmt::format("segment {} (nodes {} and {}) has no length at {}", i, a, b, describe_point(start)));
  }
}

void find_flat_triangles(const Surface& surface, std::vector<std::string>& all) {
  Sentences found(all);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto [a, b, c] = surface.triangles[i];
    const core::Vector3 p = point(surface.positions, a), q = point(surface.positions, b),
                        r = point(surface.positions, c);
    const double longest = std::max({(q - p).norm(), (r - q).norm(), (p - r).norm()});
    const double twice_area = (q - p).cross(r - p).norm();
    if (twice_area <= flattest_of_edge * longest * longest)
      found.add(fmt::format("triangle {} (nodes {}, {}, {}) has no area at {}", i, a, b, c,
                            describe_point((p + q + r) / 3)));
  }
}

/// A cell that is there twice counts twice, in stiffness, mass and contact.
template <std::size_t corners>
void find_repeated_cells(const std::vector<std::array<Index, corners>>& cells, const char* kind,
                         const Surface& surface, bool directed, std::vector<std::string>& all) {
  std::vector<std::pair<std::array<Index, corners>, std::size_t>> sorted;
  sorted.reserve(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    sorted.emplace_back(cells[i], i);
    if (!directed) std::ranges::sort(sorted.back().first);
  }
  std::ranges::sort(sorted);
  Sentences found(all);
  for (std::size_t k = 1; k < sorted.size(); ++k)
    if (sorted[k].first == sorted[k - 1].first)
      found.add(fmt::format("{0} {1} has the same corners as {0} {2}, at {3}: leave one of them out", kind,
                            sorted[k].second, sorted[k - 1].second,
                            describe_point(point(surface.positions, sorted[k].first[0]))));
}

/// Neighbours of a consistently turned surface run along their common edge in opposite directions.
void find_turned_triangles(const Surface& surface, std::vector<std::string>& all) {
  struct Use {
    int forward = 0, backward = 0;
    std::size_t last_triangle = 0;
  };
  std::map<std::pair<Index, Index>, Use> edges;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index from = surface.triangles[i][k], to = surface.triangles[i][(k + 1) % 3];
      Use& use = edges[std::minmax(from, to)];
      ++(from < to ? use.forward : use.backward);
      use.last_triangle = i;
    }
  Sentences found(all);
  for (const auto& [edge, use] : edges)
    if (use.forward + use.backward == 2 && use.forward != use.backward)
      found.add(fmt::format(
          "triangle {} is turned over against its neighbour across the edge of nodes {} and {} at {}",
          use.last_triangle, edge.first, edge.second, describe_point(point(surface.positions, edge.first))));
}

void find_dangling_nodes(const Surface& surface, std::vector<std::string>& all) {
  std::vector<char> used(static_cast<std::size_t>(surface.node_count()), 0);
  const auto mark = [&used](const auto& cells) {
    for (const auto& cell : cells)
      for (const Index node : cell) used[static_cast<std::size_t>(node)] = 1;
  };
  mark(surface.segments);
  mark(surface.triangles);
  Sentences found(all);
  for (Index node = 0; node < surface.node_count(); ++node)
    if (!used[static_cast<std::size_t>(node)])
      found.add(fmt::format("node {} at {} belongs to no segment or triangle", node,
                            describe_point(point(surface.positions, node))));
}

}  // namespace

std::vector<std::string> flat_cells(const Surface& surface) {
  std::vector<std::string> all;
  find_short_segments(surface, all);
  find_flat_triangles(surface, all);
  return all;
}

std::vector<std::string> faults(const Surface& surface, Segments segments) {
  std::vector<std::string> all;
  // What follows a bad position or reference cannot be computed.
  if (find_bad_positions(surface, all) || find_bad_references(surface, all)) return all;
  find_short_segments(surface, all);
  find_flat_triangles(surface, all);
  find_repeated_cells(surface.segments, "segment", surface, segments == Segments::directed, all);
  find_repeated_cells(surface.triangles, "triangle", surface, false, all);
  find_turned_triangles(surface, all);
  find_dangling_nodes(surface, all);
  return all;
}

void check(const Surface& surface, const std::string& what, Segments segments) {
  const auto found = faults(surface, segments);
  if (found.empty()) return;
  std::vector<core::Complaint> complaints;
  for (const auto& sentence : found)
    complaints.push_back({.file = {}, .line = 0, .column = 0, .key_path = what, .message = sentence});
  throw core::ConfigError(std::move(complaints));
}

}  // namespace talus::mesh
