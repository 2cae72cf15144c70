// Time of tying a detailed net to a coarse sheet, and of one transfer over the ties beside plain copying.
// Bytes are counted once each, whatever the caches do: the arrays of sources and weights, the values read and
// the values written. copy_gb_per_s is the machine's copy bandwidth, of arrays far larger than its caches;
// cached_copy_gb_per_s that of as many bytes as the transfer moves, which for small meshes is the speed of a
// cache. Prints one JSON object a line.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <vector>

#include "interface_mesh/mapping.hpp"
#include "interface_mesh/square_net.hpp"

using namespace talus;

namespace {

/// The fastest of several repetitions (s): what others on the machine add is never negative.
template <class Work>
double fastest_seconds(int repetitions, Work work) {
  double fastest = 1e30;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    fastest =
        std::min(fastest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return fastest;
}

mesh::Surface net(mesh::Index openings) {
  return mesh::generate(mesh::SquareNet{.lengths = {10, 10}, .openings = {openings, openings}}).surface;
}

/// Two triangles an opening.
mesh::Surface sheet(mesh::Index openings) {
  auto surface = net(openings);
  surface.segments.clear();
  const mesh::Index row = openings + 1;
  for (mesh::Index corner = 0; corner < openings * row; ++corner) {
    if (corner % row == openings) continue;
    surface.triangles.push_back({corner, corner + 1, corner + row + 1});
    surface.triangles.push_back({corner, corner + row + 1, corner + row});
  }
  surface.parts.clear();
  return surface;
}

struct Repeated {
  std::size_t bytes = 0;
  int repetitions = 0;
};

double copy_gb_per_s(const Repeated& copy) {
  std::vector<char> from(copy.bytes / 2, 1), to(copy.bytes / 2, 2);
  const double seconds =
      fastest_seconds(copy.repetitions, [&] { std::memcpy(to.data(), from.data(), from.size()); });
  return 1e-9 * double(2 * from.size()) / seconds;
}

void measure(mesh::Index nodes, double copy) {
  const auto edge = static_cast<mesh::Index>(std::lround(std::sqrt(nodes)));
  const auto boundary = net(edge - 1), structure = sheet((edge - 1) / 4 - 1);
  const double build = fastest_seconds(3, [&] { (void)mesh::tie_to_nearest_feature(boundary, structure); });

  const auto mapping = mesh::tie_to_nearest_feature(boundary, structure).mapping;
  std::vector<double> motion(structure.positions.size(), 1), carried(boundary.positions.size(), 1);
  const std::size_t values = (motion.size() + carried.size()) * sizeof(double);
  const std::size_t bytes = mapping.bytes_to_boundary() + values;
  const int repetitions = std::max(20, 20'000'000 / nodes);
  const double there = fastest_seconds(repetitions, [&] { mapping.to_boundary(motion, carried); });
  const double back = fastest_seconds(repetitions, [&] { mapping.to_structure(carried, motion); });
  const double apply = 1e-9 * double(bytes) / there;
  const double apply_back = 1e-9 * double(mapping.bytes_to_structure() + values) / back;
  fmt::print(
      "{{\"nodes\":{},\"build_s\":{:.4g},\"apply_gb_per_s\":{:.4g},\"copy_gb_per_s\":{:.4g},"
      "\"ratio\":{:.3g},\"transpose_gb_per_s\":{:.4g},\"transpose_ratio\":{:.3g},"
      "\"cached_copy_gb_per_s\":{:.4g}}}\n",
      boundary.node_count(), build, apply, copy, apply / copy, apply_back, apply_back / copy,
      copy_gb_per_s({bytes, repetitions}));
}

}  // namespace

int main() {
  constexpr std::size_t beyond_caches = std::size_t{512} << 20;
  const double copy = copy_gb_per_s({beyond_caches, 10});
  for (const mesh::Index nodes : {10'000, 100'000, 1'000'000}) measure(nodes, copy);
}
